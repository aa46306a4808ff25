# Writes extended_templates.cpp: the files of templates/ as text in a C++ file, so that a program needs no files at run time.
set(OUTPUT ${PROJECT_BINARY_DIR}/extended_templates.cpp)
file(WRITE ${OUTPUT}.new "#include \"export/extended_templates.h\"\n\nnamespace uncertainty_identification {\n\n"
  "const ExtendedTemplates& extendedTemplates() {\n  static const ExtendedTemplates kTemplates{\n")
foreach(suffix py cpp)
  file(READ ${PROJECT_SOURCE_DIR}/templates/extended_simulation.${suffix} text)
  file(APPEND ${OUTPUT}.new "R\"__template__(${text})__template__\",\n")
endforeach()
file(APPEND ${OUTPUT}.new "};\n  return kTemplates;\n}\n\n}  // namespace uncertainty_identification\n")
configure_file(${OUTPUT}.new ${OUTPUT} COPYONLY)  # untouched when nothing changed
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS templates/extended_simulation.py templates/extended_simulation.cpp)
