# The footage generator: ray casting, closed forms, determinism, files.
find_package(Threads REQUIRED)
foreach(name IN ITEMS raycast footage footage_lens footage_layers)
    add_executable(test_${name} ${CMAKE_CURRENT_LIST_DIR}/test_${name}.c
        ${PROJECT_SOURCE_DIR}/ofx_host_stub/cli/threads.c)
    target_compile_definitions(test_${name} PRIVATE _XOPEN_SOURCE=700)
    target_include_directories(test_${name} PRIVATE
        ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/ofx_host_stub)
    target_link_libraries(test_${name} PRIVATE
        wo_footage wo_raycast wo_bridge wo_base wo_options cmocka Threads::Threads m)
    add_test(NAME unit.${name} COMMAND test_${name})
endforeach()
