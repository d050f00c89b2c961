# The module as a package: find_package(Tyndall COMPONENTS volumetrics), or pkg-config tyndall-volumetrics. It knows no
# path of the tree it was built from: consumers are told where its shaders and noise lie (TYNDALL_DATA_DIR).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Tyndall)
set(header_dir ${CMAKE_INSTALL_INCLUDEDIR}/tyndall)
set(data_dir ${CMAKE_INSTALL_DATADIR}/tyndall)

set_target_properties(glad PROPERTIES OUTPUT_NAME tyndall_glad)
foreach(library core gl volumetrics)
  set_target_properties(tyndall_${library} PROPERTIES EXPORT_NAME ${library})
endforeach()
# Until version 1 each minor version may change the interface.
set_target_properties(glad tyndall_core tyndall_gl tyndall_volumetrics PROPERTIES
                      VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
                      INSTALL_RPATH "$ORIGIN" DEFINE_SYMBOL "")  # they share a precompiled header
add_library(Tyndall::volumetrics ALIAS tyndall_volumetrics)
target_compile_definitions(tyndall_volumetrics INTERFACE
                           $<INSTALL_INTERFACE:TYNDALL_DATA_DIR="$<INSTALL_PREFIX>/${data_dir}">)
if(NOT PROJECT_IS_TOP_LEVEL)  # a host that builds the module with add_subdirectory
  target_compile_definitions(tyndall_volumetrics INTERFACE
                             $<BUILD_INTERFACE:TYNDALL_DATA_DIR="${PROJECT_SOURCE_DIR}">)
endif()

# What runs: shared libraries and data.
install(TARGETS glad tyndall_core tyndall_gl tyndall_volumetrics EXPORT TyndallTargets
        INCLUDES DESTINATION ${header_dir}
        LIBRARY COMPONENT volumetrics NAMELINK_COMPONENT volumetrics-dev
        ARCHIVE COMPONENT volumetrics-dev)
foreach(folder lib shared volumetrics)
  install(DIRECTORY shaders/${folder} DESTINATION ${data_dir}/shaders COMPONENT volumetrics)
endforeach()
install(DIRECTORY assets/noise DESTINATION ${data_dir}/assets COMPONENT volumetrics)

# What hosts compile against.
install(DIRECTORY modules/volumetrics/include/ ${GLAD_DIR}/include/ DESTINATION ${header_dir}
        COMPONENT volumetrics-dev FILES_MATCHING PATTERN *.h)
install(DIRECTORY engine/gl engine/shader engine/graph DESTINATION ${header_dir}/engine COMPONENT volumetrics-dev
        FILES_MATCHING PATTERN *.h PATTERN readback.h EXCLUDE PATTERN transient_pool.h EXCLUDE)
foreach(header check error files roots settings)
  install(FILES engine/core/${header}.h DESTINATION ${header_dir}/engine/core COMPONENT volumetrics-dev)
endforeach()
install(DIRECTORY shaders/shared DESTINATION ${header_dir}/shaders COMPONENT volumetrics-dev)
install(FILES shaders/lib/glm_subset.h DESTINATION ${header_dir}/shaders/lib COMPONENT volumetrics-dev)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright COMPONENT volumetrics-dev)

install(EXPORT TyndallTargets NAMESPACE Tyndall:: DESTINATION ${package_dir} COMPONENT volumetrics-dev)
configure_package_config_file(cmake/TyndallConfig.cmake.in ${PROJECT_BINARY_DIR}/TyndallConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/TyndallConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/TyndallConfig.cmake ${PROJECT_BINARY_DIR}/TyndallConfigVersion.cmake
        DESTINATION ${package_dir} COMPONENT volumetrics-dev)
set(pc_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH prefix_from_pc /prefix/${pc_dir} /prefix)
configure_file(cmake/tyndall-volumetrics.pc.in ${PROJECT_BINARY_DIR}/tyndall-volumetrics.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/tyndall-volumetrics.pc DESTINATION ${pc_dir} COMPONENT volumetrics-dev)

# cpack: Debian packages, of shared libraries where BUILD_SHARED_LIBS is on.
if(NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()
set(runtime_package libtyndall-volumetrics${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL volumetrics volumetrics-dev)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "Tyndall maintainers <maintainers@tyndall.invalid>")
set(CPACK_DEBIAN_VOLUMETRICS_PACKAGE_NAME ${runtime_package})
set(CPACK_DEBIAN_VOLUMETRICS_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_VOLUMETRICS_PACKAGE_SHLIBDEPS ${BUILD_SHARED_LIBS})
set(CPACK_DEBIAN_VOLUMETRICS-DEV_PACKAGE_NAME libtyndall-volumetrics-dev)
set(CPACK_DEBIAN_VOLUMETRICS-DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_VOLUMETRICS-DEV_PACKAGE_DEPENDS
    "${runtime_package} (= ${PROJECT_VERSION}), libglm-dev, libfmt-dev, libspdlog-dev, nlohmann-json3-dev")
set(CPACK_COMPONENT_VOLUMETRICS_DESCRIPTION "Light in participating media for OpenGL 4.5 renderers: what runs")
set(CPACK_COMPONENT_VOLUMETRICS-DEV_DESCRIPTION
    "Light in participating media for OpenGL 4.5 renderers: what is compiled against")
include(CPack)
