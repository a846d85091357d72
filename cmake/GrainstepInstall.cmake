# What `cmake --install` gives: the programs, and what a participant of one's own needs, in C++ (find_package(Grainstep):
# Grainstep::participant, Grainstep::contact and, of the component `particles`, Grainstep::particles) or in any other
# language (the messages' declarations).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS grainstep grainstep-study grainstep-dem grainstep-grains grainstep-fe grainstep-keys grainstep-replay RUNTIME COMPONENT programs)

# What an unmodified LAMMPS loads, and the script that loads it.
install(TARGETS grainstep_lammps LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT programs)
install(FILES ${PROJECT_SOURCE_DIR}/examples/lammps/grainstep_lammps.py
  DESTINATION ${CMAKE_INSTALL_DATADIR}/grainstep/lammps COMPONENT programs)

set(include_folder ${CMAKE_INSTALL_INCLUDEDIR}/grainstep)

# grainstep_exported(name FOLDERS ... HEADERS ... PUBLIC ... PRIVATE ...): a library of these libraries' objects,
# Grainstep::name for its users. HEADERS are folders, of which all headers are installed, or single ones; PUBLIC are
# libraries that its users link as well.
function(grainstep_exported name)
  cmake_parse_arguments(arg "" "EXPORT" "FOLDERS;HEADERS;PUBLIC;PRIVATE" ${ARGN})
  add_library(grainstep-${name})
  add_library(Grainstep::${name} ALIAS grainstep-${name})
  foreach(folder IN LISTS arg_FOLDERS)
    target_sources(grainstep-${name} PRIVATE $<TARGET_OBJECTS:grainstep_${folder}>)
  endforeach()
  set_target_properties(grainstep-${name} PROPERTIES EXPORT_NAME ${name} VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} LINKER_LANGUAGE CXX)
  target_compile_features(grainstep-${name} PUBLIC cxx_std_20)
  target_include_directories(grainstep-${name} SYSTEM INTERFACE
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/common>
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/proto> $<INSTALL_INTERFACE:${include_folder}>)
  target_link_libraries(grainstep-${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  install(TARGETS grainstep-${name} EXPORT ${arg_EXPORT} COMPONENT development)
  foreach(header IN LISTS arg_HEADERS)
    if(IS_DIRECTORY ${PROJECT_SOURCE_DIR}/${header})
      install(DIRECTORY ${PROJECT_SOURCE_DIR}/${header} DESTINATION ${include_folder} COMPONENT development
        FILES_MATCHING PATTERN "*.hpp")
    else()
      string(REGEX REPLACE "^common/" "" place ${header})
      cmake_path(GET place PARENT_PATH folder)
      install(FILES ${PROJECT_SOURCE_DIR}/${header} DESTINATION ${include_folder}/${folder} COMPONENT development)
    endif()
  endforeach()
endfunction()

# What a participant works with. Its users need Protobuf, and nothing of what the programs need besides.
grainstep_exported(participant EXPORT grainstep
  FOLDERS base proto transport wire participant participant_program
  HEADERS common/base common/transport common/wire common/participant
  PUBLIC protobuf::libprotobuf Threads::Threads
  PRIVATE ${ZMQ_LINK_LIBRARIES} ${SODIUM_LINK_LIBRARIES} ${XXHASH_LINK_LIBRARIES})

# Contact of particles with the moving surface: law, forces, reactions, ledger.
grainstep_exported(contact EXPORT grainstep
  FOLDERS surface contact HEADERS common/surface common/contact PUBLIC grainstep-participant)

# A scene's slug for a particle code: masses and laws, damping that fits the step, packing, preview; and the steps of
# its windows with contact, exchange with the other side and reports. An export of its own: only its users need fmt.
grainstep_exported(particles EXPORT grainstep_particles
  FOLDERS scene_sizes dem_law dem_driver
  HEADERS common/scene/sizes.hpp dem-service/law/damping.hpp dem-service/mpi_start.hpp dem-service/slug/packing.hpp
    dem-service/law/pair_energy.hpp dem-service/law/plane_contacts.hpp dem-service/slug/preview.hpp dem-service/slug/exchange.hpp
    dem-service/slug/layout.hpp dem-service/slug/model.hpp dem-service/slug/report.hpp dem-service/slug/step_driver.hpp
  PUBLIC grainstep-contact PRIVATE fmt::fmt)

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
install(EXPORT grainstep_particles NAMESPACE Grainstep:: FILE GrainstepParticlesTargets.cmake
  DESTINATION ${package_folder} COMPONENT development)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/GrainstepConfig.cmake.in
  ${PROJECT_BINARY_DIR}/GrainstepConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/GrainstepConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/GrainstepConfig.cmake ${PROJECT_BINARY_DIR}/GrainstepConfigVersion.cmake
  DESTINATION ${package_folder} COMPONENT development)
