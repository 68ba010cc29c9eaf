# SPDX-License-Identifier: Apache-2.0
# A script for each build: the commit of the sources, in a header that is written only where it changes.
# in: SOURCE (the repository's root), HEADER -> out: `#define PILEUS_COMMIT_TEXT "v0.9.0-3-gabcdef"`,
# "" without git, without a repository of these sources, or without a commit
# docs/program.md
set(commit "")
find_program(GIT git)
if(GIT)
    # A repository of another project, into which these sources were copied, says nothing of them.
    cmake_path(GET SOURCE PARENT_PATH above)
    set(ENV{GIT_CEILING_DIRECTORIES} "${above}")
    set(ENV{GIT_OPTIONAL_LOCKS} 0)
    execute_process(COMMAND "${GIT}" describe --tags --always --dirty --match "v[0-9]*"
        WORKING_DIRECTORY "${SOURCE}"
        OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    # Names of tags may hold what a string literal may not.
    if(NOT commit MATCHES "^[A-Za-z0-9._+-]+$")
        set(commit "")
    endif()
endif()
set(text "#define PILEUS_COMMIT_TEXT \"${commit}\"\n")
set(before "")
if(EXISTS "${HEADER}")
    file(READ "${HEADER}" before)
endif()
if(NOT before STREQUAL text)
    file(WRITE "${HEADER}" "${text}")
endif()
