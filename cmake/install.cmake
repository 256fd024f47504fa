include(GNUInstallDirs)
if(TARGET roomlight)
  install(TARGETS roomlight RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
