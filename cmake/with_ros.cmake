# Messages, and what catkin exports to packages that use this one.
find_package(catkin REQUIRED COMPONENTS
  actionlib actionlib_msgs diagnostic_msgs diagnostic_updater message_generation rosbag_storage roscpp roslz4 std_msgs
  std_srvs topic_tools)
find_package(BZip2 REQUIRED)

file(GLOB MESSAGES RELATIVE ${PROJECT_SOURCE_DIR}/msg CONFIGURE_DEPENDS msg/*.msg)
file(GLOB SERVICES RELATIVE ${PROJECT_SOURCE_DIR}/srv CONFIGURE_DEPENDS srv/*.srv)
file(GLOB ACTIONS RELATIVE ${PROJECT_SOURCE_DIR}/action CONFIGURE_DEPENDS action/*.action)
add_message_files(FILES ${MESSAGES})
add_service_files(FILES ${SERVICES})
add_action_files(FILES ${ACTIONS})
generate_messages(DEPENDENCIES actionlib_msgs std_msgs)

catkin_package(
  INCLUDE_DIRS include
  LIBRARIES uncertainty_identification_core uncertainty_identification_io uncertainty_identification_ros
  CATKIN_DEPENDS actionlib actionlib_msgs diagnostic_msgs diagnostic_updater message_runtime rosbag_storage roscpp std_msgs
    std_srvs topic_tools
  DEPENDS EIGEN3)

set(PROGRAM_FOLDER ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
set(INSTALL_PROGRAMS ${CATKIN_PACKAGE_BIN_DESTINATION})
set(INSTALL_LIBRARIES ${CATKIN_PACKAGE_LIB_DESTINATION})
set(INSTALL_HEADERS ${CATKIN_PACKAGE_INCLUDE_DESTINATION})
set(INSTALL_SHARED_FILES ${CATKIN_PACKAGE_SHARE_DESTINATION})
