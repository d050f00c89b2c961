# Every dependency is a Debian package; nothing is vendored or downloaded.
find_package(glm REQUIRED)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(nlohmann_json REQUIRED)

# The glad loader is generated at build time: the only loader that works in GLFW, EGL and OSMesa contexts alike.
find_program(GLAD_EXE NAMES glad PATHS /usr/bin NO_DEFAULT_PATH REQUIRED)
set(GLAD_DIR ${CMAKE_BINARY_DIR}/glad)
add_custom_command(
  OUTPUT ${GLAD_DIR}/src/gl.c ${GLAD_DIR}/include/glad/gl.h
  COMMAND ${GLAD_EXE} --reproducible --quiet --api gl:core=4.5
          --extensions ${PROJECT_SOURCE_DIR}/cmake/gl_extensions.txt --out-path ${GLAD_DIR} c
  DEPENDS ${PROJECT_SOURCE_DIR}/cmake/gl_extensions.txt VERBATIM)
add_library(glad ${GLAD_DIR}/src/gl.c ${GLAD_DIR}/include/glad/gl.h)
target_include_directories(glad SYSTEM PUBLIC $<BUILD_INTERFACE:${GLAD_DIR}/include>)
target_link_libraries(glad PUBLIC ${CMAKE_DL_LIBS})

if(TYNDALL_GAME)
  include(cmake/game_dependencies.cmake)
endif()
