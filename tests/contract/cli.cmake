# The command line from outside, on the plugin as it is built. Thread-local memory of libraries that
# are loaded late makes LeakSanitizer of GCC 12 stumble now and then when it looks for leaks there.
set(cli_environment "ASAN_OPTIONS=intercept_tls_get_addr=0")
add_executable(json_check ${CMAKE_CURRENT_LIST_DIR}/json_check.c)
target_link_libraries(json_check PRIVATE wo_options)
add_test(NAME contract.cli
    COMMAND ${CMAKE_CURRENT_LIST_DIR}/cli.sh $<TARGET_FILE:wideopen> $<TARGET_FILE:json_check>
            ${CMAKE_CURRENT_BINARY_DIR}/cli_work)
set_tests_properties(contract.cli PROPERTIES TIMEOUT 600 ENVIRONMENT "${cli_environment}")
add_test(NAME contract.colour
    COMMAND ${CMAKE_CURRENT_LIST_DIR}/colour.sh $<TARGET_FILE:wideopen>
            ${CMAKE_CURRENT_BINARY_DIR}/colour_work)
set_tests_properties(contract.colour PROPERTIES TIMEOUT 300 ENVIRONMENT "${cli_environment}")
add_test(NAME contract.signals
    COMMAND ${CMAKE_CURRENT_LIST_DIR}/signals.sh $<TARGET_FILE:wideopen>
            ${CMAKE_CURRENT_BINARY_DIR}/signals_work)
set_tests_properties(contract.signals PROPERTIES TIMEOUT 300 ENVIRONMENT "${cli_environment}")
add_test(NAME contract.threads
    COMMAND ${CMAKE_CURRENT_LIST_DIR}/threads.sh $<TARGET_FILE:wideopen> $<TARGET_FILE:json_check>
            ${CMAKE_CURRENT_BINARY_DIR}/threads_work)
set_tests_properties(contract.threads PROPERTIES LABELS threads TIMEOUT 300
    ENVIRONMENT "${cli_environment};TSAN_OPTIONS=suppressions=${CMAKE_CURRENT_LIST_DIR}/cli_tsan.supp")

# Error against time, with a plugin that pretends.
set(tricks_bundles ${CMAKE_BINARY_DIR}/tests/tricks)
wo_add_ofx_plugin(Tricks ${CMAKE_CURRENT_LIST_DIR}/plugins/tricks_plugin.c
    CORE wo_base DIRECTORY ${tricks_bundles} NO_INSTALL)
add_test(NAME contract.bench
    COMMAND ${CMAKE_CURRENT_LIST_DIR}/bench.sh $<TARGET_FILE:wideopen> $<TARGET_FILE:json_check>
            ${CMAKE_CURRENT_BINARY_DIR}/bench_work ${tricks_bundles})
set_tests_properties(contract.bench PROPERTIES TIMEOUT 600 ENVIRONMENT "${cli_environment}")

# The camera of a file's metadata, from the file to the plugin.
add_executable(exr_tag ${CMAKE_CURRENT_LIST_DIR}/exr_tag.c)
target_include_directories(exr_tag PRIVATE ${PROJECT_SOURCE_DIR}/ofx_host_stub)
target_link_libraries(exr_tag PRIVATE wo_bridge wo_base wo_options m)
add_test(NAME contract.camera
    COMMAND ${CMAKE_CURRENT_LIST_DIR}/camera.sh $<TARGET_FILE:wideopen> $<TARGET_FILE:exr_tag>
            ${CMAKE_CURRENT_BINARY_DIR}/camera_work)
set_tests_properties(contract.camera PROPERTIES TIMEOUT 600 ENVIRONMENT "${cli_environment}")

# Clips that do not go together, and depth that is none.
add_executable(exr_change ${CMAKE_CURRENT_LIST_DIR}/exr_change.c)
target_include_directories(exr_change PRIVATE ${PROJECT_SOURCE_DIR}/ofx_host_stub)
target_link_libraries(exr_change PRIVATE wo_bridge wo_base wo_options m)
add_test(NAME contract.files
    COMMAND ${CMAKE_CURRENT_LIST_DIR}/files.sh $<TARGET_FILE:wideopen> $<TARGET_FILE:json_check>
            ${CMAKE_CURRENT_BINARY_DIR}/files_work)
set_tests_properties(contract.files PROPERTIES TIMEOUT 300 ENVIRONMENT "${cli_environment}")
add_test(NAME contract.clips
    COMMAND ${CMAKE_CURRENT_LIST_DIR}/clips.sh $<TARGET_FILE:wideopen> $<TARGET_FILE:json_check>
            ${CMAKE_CURRENT_BINARY_DIR}/clips_work $<TARGET_FILE:exr_change>)
set_tests_properties(contract.clips PROPERTIES TIMEOUT 300 ENVIRONMENT "${cli_environment}")

# Breaches, with a plugin that commits them.
add_test(NAME contract.strict
    COMMAND ${CMAKE_CURRENT_LIST_DIR}/strict.sh $<TARGET_FILE:wideopen> $<TARGET_FILE:json_check>
            ${CMAKE_CURRENT_BINARY_DIR}/strict_work ${CMAKE_CURRENT_BINARY_DIR}/host_plugins)
set_tests_properties(contract.strict PROPERTIES TIMEOUT 300 ENVIRONMENT "${cli_environment}")

# Times, with a plugin that looks at other frames.
add_test(NAME contract.frames
    COMMAND ${CMAKE_CURRENT_LIST_DIR}/frames.sh $<TARGET_FILE:wideopen> $<TARGET_FILE:json_check>
            ${CMAKE_CURRENT_BINARY_DIR}/frames_work ${CMAKE_CURRENT_BINARY_DIR}/host_plugins
            $<TARGET_FILE:exr_tag>)
set_tests_properties(contract.frames PROPERTIES TIMEOUT 300 ENVIRONMENT "${cli_environment}")

# Other tools beside ours: the script alone, without the tools. It is no code of ours that runs there.
if(NOT WO_SANITIZE)
    add_test(NAME contract.peers_without_sanitizers
        COMMAND ${CMAKE_CURRENT_LIST_DIR}/peers.sh ${PROJECT_SOURCE_DIR}/footage/peers.sh
                $<TARGET_FILE:wideopen> ${CMAKE_CURRENT_BINARY_DIR}/peers_work)
    set_tests_properties(contract.peers_without_sanitizers PROPERTIES
        TIMEOUT 300 SKIP_RETURN_CODE 77)
endif()
