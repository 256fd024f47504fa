include(GNUInstallDirs)
if(TARGET roomlight)
  install(TARGETS roomlight RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(DIRECTORY ${CMAKE_SOURCE_DIR}/viewer/dist/ DESTINATION ${CMAKE_INSTALL_DATADIR}/roomlight/viewer OPTIONAL)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/viewer/dist-baked/ DESTINATION ${CMAKE_INSTALL_DATADIR}/roomlight/baked OPTIONAL)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/viewer/dist-reports/ DESTINATION ${CMAKE_INSTALL_DATADIR}/roomlight/reports OPTIONAL)
install(FILES ${CMAKE_SOURCE_DIR}/LICENSE ${CMAKE_SOURCE_DIR}/NOTICE ${CMAKE_SOURCE_DIR}/docs/licences.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
# The pages that help texts and messages name.
install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs/use ${CMAKE_SOURCE_DIR}/docs/reference ${CMAKE_SOURCE_DIR}/docs/methods
  DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs FILES_MATCHING PATTERN "*.md")
