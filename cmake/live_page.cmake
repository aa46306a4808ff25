# The live page of the identification node is served by cpp-httplib, which Debian 12 has (libcpp-httplib-dev) and Ubuntu
# 20.04 has not. Only 0.11 will do: the server limits its clients through members that other versions declare differently.
find_package(PkgConfig QUIET)
if(PKG_CONFIG_FOUND)
  pkg_check_modules(HTTPLIB QUIET IMPORTED_TARGET "cpp-httplib >= 0.11" "cpp-httplib < 0.12")
endif()
if(HTTPLIB_FOUND)
  message(STATUS "The node's live page is served by cpp-httplib ${HTTPLIB_cpp-httplib_VERSION}")
  file(GLOB live_server CONFIGURE_DEPENDS src/live/http/*.cpp)
else()
  message(STATUS "No cpp-httplib 0.11 (Debian 12: libcpp-httplib-dev): the node's live page is left out, and a node whose "
    "live_page.port is not 0 will refuse to start")
  set(live_server src/live/without_http/live_server.cpp)
endif()
