# `cmake --install` and `find_package(penumbra COMPONENTS volumes)`. Components: mesh, volumes, checks, render. Headers keep their
# layout below include/penumbra, which is on the include path of whoever links a target: #include <volumes/volumes.h>.
include(CMakePackageConfigHelpers)

set(penumbra_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/penumbra)
foreach(module mesh volumes render)
  if(TARGET penumbra_${module})
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/${module} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/penumbra
            FILES_MATCHING PATTERN "*.h" PATTERN shaders EXCLUDE)
  endif()
endforeach()

install(EXPORT penumbra-targets NAMESPACE penumbra:: DESTINATION ${penumbra_cmake_dir})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/penumbra-config.cmake.in
                              ${PROJECT_BINARY_DIR}/penumbra-config.cmake INSTALL_DESTINATION ${penumbra_cmake_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/penumbra-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/penumbra-config.cmake ${PROJECT_BINARY_DIR}/penumbra-config-version.cmake
        DESTINATION ${penumbra_cmake_dir})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
