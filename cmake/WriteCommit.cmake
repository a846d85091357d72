# Writes the commit of SOURCE_DIR into the header OUTPUT; touches it only when it has changed, so that nothing is rebuilt.
execute_process(COMMAND git -C ${SOURCE_DIR} describe --always --abbrev=12 --match=NONE --dirty=+
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(commit unknown)
endif()
set(text "#pragma once\n#define GRAINSTEP_COMMIT \"${commit}\"\n")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT "${old}" STREQUAL "${text}")
  file(WRITE ${OUTPUT} "${text}")
endif()
