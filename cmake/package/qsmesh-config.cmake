# Targets of an installed qsmesh: qsmesh::qsmesh is the shared library, qsmesh::qsmesh_static the static one with all
# that it needs. Each is there if its file is. What they need is read from qsmesh.pc, so that one file does for every
# way of installing, and for a folder that has been moved.
get_filename_component(qsmesh_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

find_file(
    qsmesh_pc qsmesh.pc
    PATHS "${qsmesh_prefix}"
    PATH_SUFFIXES "lib/${CMAKE_LIBRARY_ARCHITECTURE}/pkgconfig" lib/pkgconfig lib64/pkgconfig
    NO_DEFAULT_PATH NO_CACHE)
find_path(qsmesh_include qsmesh.h PATHS "${qsmesh_prefix}/include" NO_DEFAULT_PATH NO_CACHE)
if(NOT qsmesh_pc OR NOT qsmesh_include)
    set(qsmesh_FOUND FALSE)
    set(qsmesh_NOT_FOUND_MESSAGE "qsmesh.pc or qsmesh.h is missing below ${qsmesh_prefix}")
    return()
endif()
get_filename_component(qsmesh_libraries "${qsmesh_pc}/../.." ABSOLUTE)

function(qsmesh_add_target name kind file)
    if(TARGET qsmesh::${name} OR NOT EXISTS "${file}")
        return()
    endif()
    add_library(qsmesh::${name} ${kind} IMPORTED)
    set_target_properties(qsmesh::${name} PROPERTIES IMPORTED_LOCATION "${file}"
                                                     INTERFACE_INCLUDE_DIRECTORIES "${qsmesh_include}")
endfunction()

if(APPLE)
    qsmesh_add_target(qsmesh SHARED "${qsmesh_libraries}/libqsmesh.dylib")
else()
    qsmesh_add_target(qsmesh SHARED "${qsmesh_libraries}/libqsmesh.so")
endif()
qsmesh_add_target(qsmesh_static STATIC "${qsmesh_libraries}/libqsmesh.a")

if(TARGET qsmesh::qsmesh_static)
    file(STRINGS "${qsmesh_pc}" qsmesh_private REGEX "^Libs.private:")
    string(REGEX REPLACE "^Libs.private: *" "" qsmesh_private "${qsmesh_private}")
    separate_arguments(qsmesh_private UNIX_COMMAND "${qsmesh_private}")
    set_target_properties(qsmesh::qsmesh_static PROPERTIES INTERFACE_LINK_LIBRARIES "${qsmesh_private}")
endif()

foreach(component IN LISTS qsmesh_FIND_COMPONENTS)
    if(component STREQUAL "shared" AND TARGET qsmesh::qsmesh)
        set(qsmesh_shared_FOUND TRUE)
    elseif(component STREQUAL "static" AND TARGET qsmesh::qsmesh_static)
        set(qsmesh_static_FOUND TRUE)
    elseif(qsmesh_FIND_REQUIRED_${component})
        set(qsmesh_FOUND FALSE)
        set(qsmesh_NOT_FOUND_MESSAGE "there is no component ${component} below ${qsmesh_prefix}; known: shared, static")
    endif()
endforeach()
