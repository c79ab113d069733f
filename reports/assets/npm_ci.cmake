# Installs the locked script libraries into OUT (never into the source tree) and leaves a stamp.
file(MAKE_DIRECTORY ${OUT})
file(COPY ${ASSETS}/package.json ${ASSETS}/package-lock.json DESTINATION ${OUT})
set(omit "")
if(NOT TESTS)
  set(omit --omit=dev)
endif()
execute_process(
  COMMAND ${NPM} ci --ignore-scripts --no-audit --no-fund --loglevel=error ${omit}
  WORKING_DIRECTORY ${OUT} RESULT_VARIABLE status OUTPUT_QUIET)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "npm ci failed (no network, or a registry that lacks a locked version). "
                      "Configure with -DSTURZ_REPORT_JS=OFF to build pages with still figures only.")
endif()
file(TOUCH ${OUT}/npm.stamp)
