# Gates: rules of the project that a machine can check. Each has a self-test beside it, which shows
# that it finds what it looks for. Gates that read sources, and self-tests of scripts, find the same
# with sanitizers; there are none of them there, nor of those that sanitizers would mislead with a
# library and variables of their own.
set(gates ${CMAKE_CURRENT_LIST_DIR})

function(wo_add_gate name)
    add_test(NAME gates.${name} COMMAND ${ARGN})
    set_tests_properties(gates.${name} PROPERTIES LABELS gates)
endfunction()

if(NOT WO_SANITIZE)
    # Who includes whom, and what core and plugins keep off.
    wo_add_gate(include_direction ${gates}/include_direction.sh ${PROJECT_SOURCE_DIR})
    wo_add_gate(selftest_include_direction ${gates}/selftest.sh include_direction)

    # Form of the files.
    wo_add_gate(hygiene ${gates}/hygiene.sh ${PROJECT_SOURCE_DIR})
    wo_add_gate(selftest_hygiene ${gates}/selftest.sh hygiene)

    # Each public header alone, as C11 and as C++17; with Clang, too, where there is one.
    wo_add_gate(headers ${gates}/headers.sh
        ${CMAKE_C_COMPILER} ${CMAKE_CXX_COMPILER} ${PROJECT_SOURCE_DIR})
    wo_add_gate(selftest_headers ${gates}/selftest.sh headers
        ${CMAKE_C_COMPILER} ${CMAKE_CXX_COMPILER})
    find_program(WO_CLANG clang)
    find_program(WO_CLANGXX clang++)
    mark_as_advanced(WO_CLANG WO_CLANGXX)
    if(WO_CLANG AND WO_CLANGXX AND NOT CMAKE_C_COMPILER_ID MATCHES "Clang")
        wo_add_gate(headers_clang ${gates}/headers.sh
            ${WO_CLANG} ${WO_CLANGXX} ${PROJECT_SOURCE_DIR})
    endif()
endif()

# What the plugins show and want, and that the core keeps no state.
if(CMAKE_SYSTEM_NAME STREQUAL "Linux")
    wo_add_gate(bundle_exports ${gates}/bundles.sh exports ${WO_PLUGIN_DIR})
    if(NOT WO_SANITIZE)
        wo_add_gate(bundle_needed ${gates}/bundles.sh needed ${WO_PLUGIN_DIR})
        wo_add_gate(core_state ${gates}/state.sh
            $<TARGET_FILE:wo_base> $<TARGET_FILE:wo_core>)
        wo_add_gate(selftest_bundles ${gates}/selftest.sh bundles ${CMAKE_C_COMPILER})
        wo_add_gate(selftest_state ${gates}/selftest.sh state ${CMAKE_C_COMPILER})
    endif()
endif()

# The parameter tables of all effects, and the pages in core/effects that describe them.
add_executable(effect_table
    ${gates}/effect_check.c
    ${gates}/effect_page.c
    ${gates}/effect_pictures.c
    ${gates}/effect_selftest.c
    ${gates}/effect_table.c)
target_include_directories(effect_table PRIVATE ${PROJECT_SOURCE_DIR})
target_link_libraries(effect_table PRIVATE wo_core wo_base wo_options m)
wo_add_gate(effect_tables effect_table check)
wo_add_gate(effect_pages effect_table pages ${PROJECT_SOURCE_DIR}/core/effects)
wo_add_gate(effect_pictures effect_table pictures LensBlur
    ${PROJECT_SOURCE_DIR}/footage/parameter_pictures.txt ${PROJECT_SOURCE_DIR}/footage/pictures)
wo_add_gate(selftest_effects effect_table selftest)

# Our OpenFX headers against the facts of the standard.
set(contract ${PROJECT_SOURCE_DIR}/tests/contract)
add_executable(ofx_signatures ${contract}/ofx_signatures.c)
target_include_directories(ofx_signatures PRIVATE ${PROJECT_SOURCE_DIR}/include/ofx)
target_link_libraries(ofx_signatures PRIVATE wo_options)
add_test(NAME contract.ofx_signatures COMMAND ofx_signatures)
if(WO_SANITIZE)
    return()
endif()
add_test(NAME contract.ofx_abi COMMAND ${contract}/ofx_abi.sh ${CMAKE_C_COMPILER}
    ${PROJECT_SOURCE_DIR}/include/ofx ${contract}/ofx_abi_dump.c ${contract}/ofx_abi_expect.txt
    ${CMAKE_CURRENT_BINARY_DIR}/ofx_abi)
wo_add_gate(selftest_abi ${gates}/selftest.sh abi ${CMAKE_C_COMPILER} ${PROJECT_SOURCE_DIR})

# The formatting of .clang-format, where its version is installed: others write other blanks.
find_program(WO_CLANG_FORMAT NAMES clang-format-14 clang-format)
mark_as_advanced(WO_CLANG_FORMAT)
if(WO_CLANG_FORMAT)
    execute_process(COMMAND ${WO_CLANG_FORMAT} --version
        OUTPUT_VARIABLE clang_format_version ERROR_QUIET)
endif()
if("${clang_format_version}" MATCHES "version 14\\.")
    wo_add_gate(format ${gates}/format.sh ${WO_CLANG_FORMAT} ${PROJECT_SOURCE_DIR})
    wo_add_gate(selftest_format ${gates}/selftest.sh format ${WO_CLANG_FORMAT})
else()
    message(STATUS "clang-format 14 is not installed: there is no test gates.format")
endif()
