# Targets qsmesh::qsmesh (shared) and qsmesh::qsmesh_static in the tree of a project that holds these sources.
separate_arguments(native_libraries UNIX_COMMAND "${QSMESH_NATIVE_LIBRARIES}")

add_library(qsmesh::qsmesh SHARED IMPORTED GLOBAL)
set_target_properties(
    qsmesh::qsmesh
    PROPERTIES IMPORTED_LOCATION "${QSMESH_LIBRARY_FOLDER}/${QSMESH_SHARED_NAME}"
               IMPORTED_SONAME "${QSMESH_SONAME}"
               INTERFACE_INCLUDE_DIRECTORIES "${CMAKE_CURRENT_SOURCE_DIR}/include")

add_library(qsmesh::qsmesh_static STATIC IMPORTED GLOBAL)
set_target_properties(
    qsmesh::qsmesh_static
    PROPERTIES IMPORTED_LOCATION "${QSMESH_LIBRARY_FOLDER}/${QSMESH_STATIC_NAME}"
               INTERFACE_LINK_LIBRARIES "${native_libraries}"
               INTERFACE_INCLUDE_DIRECTORIES "${CMAKE_CURRENT_SOURCE_DIR}/include")

add_dependencies(qsmesh::qsmesh qsmesh_cargo)
add_dependencies(qsmesh::qsmesh_static qsmesh_cargo)
