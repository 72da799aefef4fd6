# Timings; built with the tests so that they stay compilable, run by hand: bin/bench_lens_blur --help.
# With sanitizers they would say nothing.
if(WO_SANITIZE)
    return()
endif()
add_executable(bench_lens_blur ${CMAKE_CURRENT_LIST_DIR}/bench_lens_blur.c)
target_compile_definitions(bench_lens_blur PRIVATE _POSIX_C_SOURCE=200809L)
target_link_libraries(bench_lens_blur PRIVATE wo_blur_footage wo_test_scenes)

add_executable(bench_lens_models ${CMAKE_CURRENT_LIST_DIR}/bench_lens_models.c)
target_compile_definitions(bench_lens_models PRIVATE _POSIX_C_SOURCE=200809L)
target_link_libraries(bench_lens_models PRIVATE wo_test_scenes)

add_executable(bench_pencil_map ${CMAKE_CURRENT_LIST_DIR}/bench_pencil_map.c)
target_compile_definitions(bench_pencil_map PRIVATE _POSIX_C_SOURCE=200809L)
target_link_libraries(bench_pencil_map PRIVATE wo_core wo_options m)

add_executable(bench_spread ${CMAKE_CURRENT_LIST_DIR}/bench_spread.c)
target_compile_definitions(bench_spread PRIVATE _POSIX_C_SOURCE=200809L)
target_link_libraries(bench_spread PRIVATE wo_test_scenes)

add_executable(bench_copy ${CMAKE_CURRENT_LIST_DIR}/bench_copy.c)
target_compile_definitions(bench_copy PRIVATE _POSIX_C_SOURCE=200809L)
target_link_libraries(bench_copy PRIVATE wo_test_scenes)
