# Target qsmesh_cargo: both libraries in lib/ of the build folder, under the names that they keep when installed.
find_program(QSMESH_CARGO cargo HINTS "$ENV{CARGO_HOME}/bin" "$ENV{HOME}/.cargo/bin" DOC "Builds the Rust sources")
if(NOT QSMESH_CARGO)
    message(FATAL_ERROR "qsmesh: cargo is missing; it comes with Rust 1.89 or newer")
endif()

set(QSMESH_CARGO_FOLDER "${CMAKE_CURRENT_BINARY_DIR}/cargo" CACHE PATH "Where cargo keeps what it compiles")
set(QSMESH_LIBRARY_FOLDER "${CMAKE_CURRENT_BINARY_DIR}/lib")
set(cargo_output "${QSMESH_CARGO_FOLDER}/release")

# Only cargo knows what has changed, so it is asked in every build.
add_custom_target(
    qsmesh_cargo ALL
    COMMAND
        ${CMAKE_COMMAND} -E env "CARGO_TARGET_DIR=${QSMESH_CARGO_FOLDER}" "${QSMESH_CARGO}" rustc --release --locked
        --lib --crate-type cdylib,staticlib -- ${QSMESH_SONAME_ARGUMENTS}
    COMMAND ${CMAKE_COMMAND} -E make_directory "${QSMESH_LIBRARY_FOLDER}"
    COMMAND ${CMAKE_COMMAND} -E copy_if_different "${cargo_output}/${QSMESH_STATIC_NAME}" "${QSMESH_LIBRARY_FOLDER}"
    COMMAND
        ${CMAKE_COMMAND} -E copy_if_different "${cargo_output}/${QSMESH_CARGO_NAME}"
        "${QSMESH_LIBRARY_FOLDER}/${QSMESH_SHARED_NAME}"
    COMMAND
        ${CMAKE_COMMAND} -E create_symlink ${QSMESH_SHARED_NAME} "${QSMESH_LIBRARY_FOLDER}/${QSMESH_SONAME}"
    COMMAND ${CMAKE_COMMAND} -E create_symlink ${QSMESH_SONAME} "${QSMESH_LIBRARY_FOLDER}/${QSMESH_CARGO_NAME}"
    BYPRODUCTS
        "${QSMESH_LIBRARY_FOLDER}/${QSMESH_STATIC_NAME}" "${QSMESH_LIBRARY_FOLDER}/${QSMESH_SHARED_NAME}"
        "${QSMESH_LIBRARY_FOLDER}/${QSMESH_SONAME}" "${QSMESH_LIBRARY_FOLDER}/${QSMESH_CARGO_NAME}"
    WORKING_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}"
    COMMENT "Building qsmesh with cargo"
    USES_TERMINAL VERBATIM)

# The compiler itself says what its standard library needs beside the static library of a crate.
file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/nothing.rs" "")
find_program(QSMESH_RUSTC rustc HINTS "$ENV{CARGO_HOME}/bin" "$ENV{HOME}/.cargo/bin" DOC "The Rust compiler")
execute_process(
    COMMAND "${QSMESH_RUSTC}" --crate-type staticlib --print native-static-libs nothing.rs -o nothing.a
    WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}"
    ERROR_VARIABLE said RESULT_VARIABLE failed)
string(REGEX MATCH "native-static-libs: ([^\n]*)" found "${said}")
if(failed OR NOT found)
    message(FATAL_ERROR "qsmesh: rustc does not say what a static library needs: ${said}")
endif()
string(STRIP "${CMAKE_MATCH_1}" QSMESH_NATIVE_LIBRARIES)
