# What `cmake --install` gives: the programs, and what a participant of one's own needs, in C++ (find_package(Grainstep),
# target Grainstep::participant) or in any other language (the messages' declarations).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS grainstep grainstep-dem grainstep-fe grainstep-keys RUNTIME COMPONENT programs)

# What an unmodified LAMMPS loads, and the script that loads it.
install(TARGETS grainstep_lammps LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT programs)
install(FILES ${PROJECT_SOURCE_DIR}/examples/lammps/grainstep_lammps.py
  DESTINATION ${CMAKE_INSTALL_DATADIR}/grainstep/lammps COMPONENT programs)

# One library of the folders that a participant works with. Its users need Protobuf and ZeroMQ, and nothing of what the
# programs need besides.
set(participant_folders base proto transport wire participant participant_program)
add_library(grainstep-participant)
add_library(Grainstep::participant ALIAS grainstep-participant)
foreach(folder IN LISTS participant_folders)
  target_sources(grainstep-participant PRIVATE $<TARGET_OBJECTS:grainstep_${folder}>)
endforeach()
set_target_properties(grainstep-participant PROPERTIES EXPORT_NAME participant VERSION ${PROJECT_VERSION}
  SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} LINKER_LANGUAGE CXX)
target_compile_features(grainstep-participant PUBLIC cxx_std_20)
set(include_folder ${CMAKE_INSTALL_INCLUDEDIR}/grainstep)
target_include_directories(grainstep-participant SYSTEM INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/common> $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/proto>
  $<INSTALL_INTERFACE:${include_folder}>)
target_link_libraries(grainstep-participant PUBLIC protobuf::libprotobuf Threads::Threads
  PRIVATE ${ZMQ_LINK_LIBRARIES} ${SODIUM_LINK_LIBRARIES} ${XXHASH_LINK_LIBRARIES})

install(TARGETS grainstep-participant EXPORT grainstep COMPONENT development)
foreach(folder base transport wire participant)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/common/${folder} DESTINATION ${include_folder} COMPONENT development
    FILES_MATCHING PATTERN "*.hpp")
endforeach()
foreach(name options scene wire)
  install(FILES ${PROJECT_BINARY_DIR}/proto/grainstep/${name}.pb.h DESTINATION ${include_folder}/grainstep
    COMPONENT development)
  install(FILES ${PROJECT_SOURCE_DIR}/proto/grainstep/${name}.proto
    DESTINATION ${CMAKE_INSTALL_DATADIR}/grainstep/proto/grainstep COMPONENT development)
endforeach()
install(FILES ${PROJECT_SOURCE_DIR}/proto/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME protocol.md
  COMPONENT development)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/configs DESTINATION ${CMAKE_INSTALL_DATADIR}/grainstep COMPONENT programs)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Grainstep)
install(EXPORT grainstep NAMESPACE Grainstep:: FILE GrainstepTargets.cmake DESTINATION ${package_folder}
  COMPONENT development)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/GrainstepConfig.cmake.in
  ${PROJECT_BINARY_DIR}/GrainstepConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/GrainstepConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/GrainstepConfig.cmake ${PROJECT_BINARY_DIR}/GrainstepConfigVersion.cmake
  DESTINATION ${package_folder} COMPONENT development)
