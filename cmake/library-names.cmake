# File names of the shared library. Versions that begin with 0 promise the same interface only as long as the second
# number stays, so that is part of the name under which programs look for the library.
if(NOT UNIX)
    message(FATAL_ERROR "qsmesh: CMake builds the library on Unix systems only; use `cargo build --release` here")
endif()

if(PROJECT_VERSION_MAJOR GREATER 0)
    set(QSMESH_INTERFACE_VERSION ${PROJECT_VERSION_MAJOR})
else()
    set(QSMESH_INTERFACE_VERSION 0.${PROJECT_VERSION_MINOR})
endif()

set(QSMESH_STATIC_NAME libqsmesh.a)
if(APPLE)
    set(QSMESH_CARGO_NAME libqsmesh.dylib)
    set(QSMESH_SHARED_NAME libqsmesh.${PROJECT_VERSION}.dylib)
    set(QSMESH_SONAME libqsmesh.${QSMESH_INTERFACE_VERSION}.dylib)
    set(QSMESH_SONAME_ARGUMENTS -C link-arg=-Wl,-install_name,@rpath/${QSMESH_SONAME})
else()
    set(QSMESH_CARGO_NAME libqsmesh.so)
    set(QSMESH_SHARED_NAME libqsmesh.so.${PROJECT_VERSION})
    set(QSMESH_SONAME libqsmesh.so.${QSMESH_INTERFACE_VERSION})
    set(QSMESH_SONAME_ARGUMENTS -C link-arg=-Wl,-soname,${QSMESH_SONAME})
endif()
