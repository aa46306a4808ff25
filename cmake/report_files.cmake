# Writes report_files.cpp: what a report is made of (report/, and Chart.js from this machine) as text in a C++ file, so
# that a program needs no files at run time. Also a script: cmake -DSOURCE=... -DOUTPUT=... [-DCHART_JS=...] -P this.
find_file(CHART_JS NAMES chart.min.js chart.umd.min.js chart.umd.js Chart.min.js
  PATHS /usr/share/javascript/chart.js /usr/share/nodejs/chart.js/dist NO_DEFAULT_PATH
  DOC "Chart.js, version 3 or newer, minified: what draws a report's figures")

# A constant k<name> that holds the text.
function(append_text name text)
  file(APPEND ${OUTPUT}.new "const char* const k${name} = R\"__report__(${text})__report__\";\n")
endfunction()

set(chart "")
set(chart_version "")
if(CHART_JS AND EXISTS "${CHART_JS}")
  file(READ "${CHART_JS}" chart)
  if(chart MATCHES "Chart\\.js v([0-9]+)(\\.[0-9.]+)")
    set(chart_version "${CMAKE_MATCH_1}${CMAKE_MATCH_2}")
  endif()
  if(NOT chart_version VERSION_GREATER_EQUAL 3)
    message(STATUS "${CHART_JS} is Chart.js '${chart_version}'; 3 or newer is needed")
    set(chart "")
    set(chart_version "")
  endif()
endif()
if(chart)
  message(STATUS "Reports with Chart.js ${chart_version}: ${CHART_JS}")
else()
  message(STATUS "No Chart.js: the program 'report' will say what to install")
endif()

set(script "")
file(GLOB script_files ${SOURCE}/*.js)
list(SORT script_files)
list(REMOVE_ITEM script_files ${SOURCE}/live.js)  # of the live page only
foreach(file ${script_files})
  file(READ ${file} text)
  string(APPEND script "${text}\n")
endforeach()
file(READ ${SOURCE}/report.html page)
file(READ ${SOURCE}/report.css style)
file(READ ${SOURCE}/live.html live_page)
file(READ ${SOURCE}/live.js live_script)

file(WRITE ${OUTPUT}.new "#include \"io/report_files.h\"\n\n"
  "namespace uncertainty_identification {\nnamespace {\n\n")
append_text(Page "${page}")
append_text(Style "${style}")
append_text(Script "${script}")
append_text(LivePage "${live_page}")
append_text(LiveScript "${live_script}")
append_text(Chart "${chart}")
file(APPEND ${OUTPUT}.new "\n}  // namespace\n\nconst ReportFiles& reportFiles() {\n"
  "  static const ReportFiles kFiles{kPage, kStyle, kScript, kLivePage, kLiveScript, kChart, \"${chart_version}\"};\n"
  "  return kFiles;\n}\n\n}  // namespace uncertainty_identification\n")
configure_file(${OUTPUT}.new ${OUTPUT} COPYONLY)  # untouched when nothing changed
