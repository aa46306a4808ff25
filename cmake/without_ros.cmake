# A machine without ROS: the core and io libraries, and the programs that read CSV files.
message(STATUS "catkin was not found, so ROS is left out: the libraries core and io are built, and the programs inspect, identify, "
  "explain, simulate, sample, export and report, which read CSV files but no bags. Nodes and tests need ROS (scripts/setup).")
include(GNUInstallDirs)
option(BUILD_SHARED_LIBS "Build shared libraries" ON)
set(PROGRAM_FOLDER ${PROJECT_BINARY_DIR}/bin)
set(INSTALL_PROGRAMS ${CMAKE_INSTALL_BINDIR})
set(INSTALL_LIBRARIES ${CMAKE_INSTALL_LIBDIR})
set(INSTALL_HEADERS ${CMAKE_INSTALL_INCLUDEDIR}/${PROJECT_NAME})
set(INSTALL_SHARED_FILES ${CMAKE_INSTALL_DATADIR}/${PROJECT_NAME})
