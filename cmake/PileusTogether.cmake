# SPDX-License-Identifier: Apache-2.0
# Compiles several files as one, for most of the time goes into reading the same headers anew.
# in: a target, the most files of a piece, a word of its own where it shares files with another
# -> out: its files in pieces: those that include fmt or nlohmann/json in pieces of their own; files that
# give the same name to something of theirs apart
# PILEUS_TOGETHER=OFF compiles each file by itself, which is what one wants who edits a few.
# A file that names a type or constant of its own as a header does is compiled by itself.

# Names of types and constants at the start of lines of `text`.
function(pileus_own_names text result)
    string(REPLACE "[" "(" text "\n${text}")
    string(REGEX MATCHALL "\n(struct|class|enum class|union|using) [A-Za-z_][A-Za-z0-9_]*" types "${text}")
    list(TRANSFORM types REPLACE ".* " "")
    string(REGEX MATCHALL "\n(constexpr|const) [^\n;=]*[ =({]" lines "${text}")
    string(REGEX MATCHALL "k[A-Z][A-Za-z0-9]*" constants "${lines}")
    set(${result} ${types} ${constants} PARENT_SCOPE)
endfunction()

# The same of all headers, once.
function(pileus_header_names result)
    get_property(names GLOBAL PROPERTY PILEUS_HEADER_NAMES)
    if(NOT names)
        file(GLOB_RECURSE headers "${PROJECT_SOURCE_DIR}/src/*.h" "${PROJECT_SOURCE_DIR}/platform/*.h"
            "${PROJECT_SOURCE_DIR}/kernels_cpu/*.h" "${PROJECT_SOURCE_DIR}/lab/*.h")
        foreach(header IN LISTS headers)
            file(READ "${header}" text)
            # Constants within its functions, too: another file's would be hidden by them.
            string(REGEX REPLACE "\n +constexpr" "\nconstexpr" text "${text}")
            pileus_own_names("${text}" own)
            list(APPEND names ${own})
        endforeach()
        list(REMOVE_DUPLICATES names)
        set_property(GLOBAL PROPERTY PILEUS_HEADER_NAMES "${names}")
    endif()
    set(${result} ${names} PARENT_SCOPE)
endfunction()

function(pileus_compile_together target most)
    if(NOT PILEUS_TOGETHER)
        return()
    endif()
    get_target_property(sources ${target} SOURCES)
    pileus_header_names(header_names)
    foreach(source IN LISTS sources)
        if(NOT source MATCHES "[.]cpp$")
            continue()
        endif()
        file(READ "${source}" text)
        pileus_own_names("${text}" own)
        set(both ${own})
        list(REMOVE_ITEM both ${header_names})
        if(NOT "${both}" STREQUAL "${own}")
            set_source_files_properties("${source}" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
            continue()
        endif()
        # The large headers, and what tests share, whose names others may give to something of theirs.
        string(REGEX MATCHALL "\n#include (<(fmt|nlohmann)/|\"tests/[^\"]*)" kind "${text}")
        list(TRANSFORM kind REPLACE "<(fmt|nlohmann)/.*" "text")
        list(REMOVE_DUPLICATES kind)
        # Files that two targets share are in the later one's pieces, which are none of the other's.
        string(MD5 kind "${kind}${ARGN}")
        string(SUBSTRING ${kind} 0 6 kind)
        if(NOT DEFINED pieces_${kind})
            set(pieces_${kind} 0)
        endif()
        # What stands at the start of a line before a parenthesis, a brace, a bracket or "=" is a name,
        # and so is a constant within a function, which would hide another file's.
        string(REGEX REPLACE "\n +constexpr" "\nconstexpr" text "${text}")
        string(REGEX REPLACE "\n(namespace|#|//|  |\\}|template)[^\n]*" "" text "${text}")
        string(REPLACE "[" "(" text "${text}")
        string(REGEX MATCHALL "[A-Za-z_][A-Za-z0-9_]*( [{=:]|[(])" names "${text}")
        list(TRANSFORM names REPLACE "[^A-Za-z0-9_]+$" "")
        list(REMOVE_ITEM names TEST_CASE TEST_CASE_TEMPLATE)
        list(REMOVE_DUPLICATES names)
        # The first piece with room that has none of these names, else a new one.
        set(chosen ${pieces_${kind}})
        foreach(piece RANGE ${pieces_${kind}})
            set(both ${names} ${names_${kind}_${piece}})
            list(LENGTH both before)
            list(REMOVE_DUPLICATES both)
            list(LENGTH both after)
            list(LENGTH files_${kind}_${piece} number)
            if(before EQUAL after AND number LESS most)
                set(chosen ${piece})
                break()
            endif()
        endforeach()
        if(chosen EQUAL pieces_${kind})
            math(EXPR pieces_${kind} "${chosen} + 1")
        endif()
        list(APPEND files_${kind}_${chosen} "${source}")
        list(APPEND names_${kind}_${chosen} ${names})
        set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${kind}_${chosen}")
    endforeach()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
