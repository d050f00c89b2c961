# Every dependency is a Debian package; nothing is vendored or downloaded.
find_package(PkgConfig REQUIRED)
find_package(glm REQUIRED)
find_package(glfw3 REQUIRED)
find_package(OpenGL REQUIRED COMPONENTS EGL)
find_package(spdlog REQUIRED)
find_package(fmt REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(TinyGLTF REQUIRED)
find_package(meshoptimizer REQUIRED)
find_package(OpenImageIO REQUIRED)
find_package(PNG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(Bullet REQUIRED)
find_package(embree 3 REQUIRED)
find_package(Threads REQUIRED)
find_package(GTest REQUIRED)
pkg_check_modules(IMGUI REQUIRED IMPORTED_TARGET imgui)

# Debian's OpenImageIO target lists an OpenCV include folder that its package does not install.
get_target_property(oiio_includes OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
list(FILTER oiio_includes EXCLUDE REGEX opencv)
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${oiio_includes}")

add_library(bullet INTERFACE)
target_include_directories(bullet SYSTEM INTERFACE ${BULLET_INCLUDE_DIRS})
target_link_libraries(bullet INTERFACE ${BULLET_LIBRARIES})

# OpenVDB's own find module wants a component of Boost that its package does not need. NanoVDB lies beside it.
find_path(OPENVDB_INCLUDE_DIR openvdb/openvdb.h REQUIRED)
find_path(NANOVDB_INCLUDE_DIR nanovdb/NanoVDB.h REQUIRED)
find_path(BLOSC_INCLUDE_DIR blosc.h REQUIRED)
find_library(OPENVDB_LIBRARY openvdb REQUIRED)
find_library(BLOSC_LIBRARY blosc REQUIRED)
pkg_check_modules(IMATH REQUIRED IMPORTED_TARGET Imath)
find_package(TBB REQUIRED COMPONENTS tbb)
add_library(nanovdb INTERFACE)
target_include_directories(nanovdb SYSTEM INTERFACE ${NANOVDB_INCLUDE_DIR} ${BLOSC_INCLUDE_DIR})
target_link_libraries(nanovdb INTERFACE ${BLOSC_LIBRARY} ZLIB::ZLIB)
add_library(openvdb INTERFACE)
target_include_directories(openvdb SYSTEM INTERFACE ${OPENVDB_INCLUDE_DIR})
target_link_libraries(openvdb INTERFACE ${OPENVDB_LIBRARY} TBB::tbb PkgConfig::IMATH)

# The glad loader is generated at build time: the only loader that works in GLFW, EGL and OSMesa contexts alike.
find_program(GLAD_EXE NAMES glad PATHS /usr/bin NO_DEFAULT_PATH REQUIRED)
set(GLAD_DIR ${CMAKE_BINARY_DIR}/glad)
add_custom_command(
  OUTPUT ${GLAD_DIR}/src/gl.c ${GLAD_DIR}/include/glad/gl.h
  COMMAND ${GLAD_EXE} --reproducible --quiet --api gl:core=4.5
          --extensions ${PROJECT_SOURCE_DIR}/cmake/gl_extensions.txt --out-path ${GLAD_DIR} c
  DEPENDS ${PROJECT_SOURCE_DIR}/cmake/gl_extensions.txt VERBATIM)
add_library(glad STATIC ${GLAD_DIR}/src/gl.c ${GLAD_DIR}/include/glad/gl.h)
target_include_directories(glad SYSTEM PUBLIC ${GLAD_DIR}/include)
target_link_libraries(glad PUBLIC ${CMAKE_DL_LIBS})
