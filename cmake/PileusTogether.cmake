# SPDX-License-Identifier: Apache-2.0
# Compiles files that read the same large headers as one, which takes a third of the time.
# in: a target, a number of pieces -> out: its files that include fmt or nlohmann/json, in so many pieces
# Their names without linkage must differ from one another: a clash is an error of the compiler.
function(pileus_compile_together target pieces)
    get_target_property(sources ${target} SOURCES)
    set(number 0)
    foreach(source IN LISTS sources)
        if(NOT source MATCHES "[.]cpp$")
            continue()
        endif()
        file(STRINGS "${source}" found REGEX "^#include <(fmt|nlohmann)/" LIMIT_COUNT 1)
        if(found)
            math(EXPR piece "${number} % ${pieces}")
            math(EXPR number "${number} + 1")
            set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${target}_${piece}")
        endif()
    endforeach()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
