# The OFX host against plugins that behave, plugins that do not, and files that are no plugins.
find_package(Threads REQUIRED)
set(host_test_dir ${CMAKE_CURRENT_LIST_DIR})
set(host_test_plugins ${CMAKE_CURRENT_BINARY_DIR}/host_plugins)
if(CMAKE_SYSTEM_NAME STREQUAL "Darwin")
    set(host_test_arch MacOS)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    set(host_test_arch ${CMAKE_SYSTEM_NAME}-x86-64)
else()
    set(host_test_arch ${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR})
endif()

# A test plugin as a bundle in a folder of its own: host_plugins/FOLDER/NAME.ofx.bundle.
function(wo_host_test_plugin target folder name source)
    add_library(${target} MODULE ${host_test_dir}/plugins/${source})
    target_include_directories(${target} PRIVATE
        ${host_test_dir}/../../include ${host_test_dir}/../../include/ofx)
    target_link_libraries(${target} PRIVATE wo_options m)
    set_target_properties(${target} PROPERTIES PREFIX "" SUFFIX ".ofx" OUTPUT_NAME ${name}
        LIBRARY_OUTPUT_DIRECTORY
        ${host_test_plugins}/${folder}/${name}.ofx.bundle/Contents/${host_test_arch})
    set_property(GLOBAL APPEND PROPERTY wo_host_test_plugins ${target})
endfunction()
wo_host_test_plugin(host_plugin_good good Good good.c)
wo_host_test_plugin(host_plugin_bad bad Bad bad.c)
wo_host_test_plugin(host_plugin_legal legal Legal legal.c)
wo_host_test_plugin(host_plugin_frames frames Frames frames.c)
target_compile_definitions(host_plugin_legal PRIVATE _XOPEN_SOURCE=700)
target_link_libraries(host_plugin_legal PRIVATE Threads::Threads)
wo_host_test_plugin(host_plugin_odd odd Odd odd.c)
wo_host_test_plugin(host_plugin_shy shy Shy shy.c)
wo_host_test_plugin(host_plugin_half shy Half shy.c)
target_compile_definitions(host_plugin_half PRIVATE WO_TEST_LACKS_PLUGIN)
wo_host_test_plugin(host_plugin_fresh fresh Fresh fresh.c)

# Plugins no host wants to live with, each in a folder named by its fault; those that never answer
# are in folders of their own.
foreach(fault IN ITEMS LoadCrash LoadExit LoadShout DescribeCrash DescribeExit DescribeThread
        DescribeMerge DescribeWrong UnloadCrash CountMany CountNegative GetCrash GetNull)
    wo_host_test_plugin(host_plugin_${fault} faulty ${fault} faulty.c)
    target_compile_definitions(host_plugin_${fault} PRIVATE WO_TEST_FAULT="${fault}")
endforeach()
foreach(fault IN ITEMS LoadHang DescribeHang UnloadHang)
    wo_host_test_plugin(host_plugin_${fault} hanging ${fault} faulty.c)
    target_compile_definitions(host_plugin_${fault} PRIVATE WO_TEST_FAULT="${fault}")
endforeach()

add_library(wo_host_fixture STATIC
    ${host_test_dir}/host_fixture.c ${host_test_dir}/apart_fixture.c)
target_include_directories(wo_host_fixture PUBLIC ${host_test_dir})
target_compile_definitions(wo_host_fixture PUBLIC
    _XOPEN_SOURCE=700 WO_TEST_PLUGINS="${host_test_plugins}" WO_TEST_ARCH="${host_test_arch}")
target_link_libraries(wo_host_fixture PUBLIC
    wo_host wo_base wo_options cmocka Threads::Threads ${CMAKE_DL_LIBS} m)
get_property(host_test_targets GLOBAL PROPERTY wo_host_test_plugins)
add_dependencies(wo_host_fixture ${host_test_targets})

foreach(name IN ITEMS describe scan values params render misdeeds legal threads memory apart cache)
    add_executable(test_host_${name} ${host_test_dir}/test_host_${name}.c)
    target_include_directories(test_host_${name} PRIVATE ${host_test_dir}/../../include/ofx)
    target_link_libraries(test_host_${name} PRIVATE wo_host_fixture)
    add_test(NAME contract.host_${name} COMMAND test_host_${name})
endforeach()
add_test(NAME contract.faulty_plugins
    COMMAND ${host_test_dir}/faulty_plugins.sh $<TARGET_FILE:wideopen> $<TARGET_FILE:json_check>
            ${CMAKE_CURRENT_BINARY_DIR}/faulty_work ${host_test_plugins})
set_tests_properties(contract.faulty_plugins PROPERTIES TIMEOUT 300
    ENVIRONMENT "ASAN_OPTIONS=intercept_tls_get_addr=0")
set_tests_properties(contract.host_threads PROPERTIES LABELS threads)
# Every allocation of the host goes through functions that can be told to fail.
foreach(function IN ITEMS malloc calloc realloc aligned_alloc)
    target_link_options(test_host_memory PRIVATE -Wl,--wrap=${function})
endforeach()
