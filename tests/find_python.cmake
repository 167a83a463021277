# Sets VORPIPE_TEST_PYTHON, unless it was given, to the python3 that has the most of the modules that tests import: a
# machine may have several, and the first one of PATH need not be the one for which packages are installed.
# Empty where there is none.
if(NOT VORPIPE_TEST_PYTHON)
  set(modules numpy shapely vtkmodules)
  list(JOIN modules "', '" quoted)
  set(count_modules "from importlib.util import find_spec; print(sum(find_spec(name) is not None for name in ['${quoted}']))")
  list(LENGTH modules all)
  find_program(python_on_path python3 NO_CACHE)
  set(most -1)
  foreach(python /usr/bin/python3 ${python_on_path} /usr/local/bin/python3 /opt/homebrew/bin/python3)
    if(EXISTS ${python} AND most LESS all)
      execute_process(COMMAND ${python} -c "${count_modules}" OUTPUT_VARIABLE found RESULT_VARIABLE code ERROR_QUIET
                      OUTPUT_STRIP_TRAILING_WHITESPACE)
      if(code EQUAL 0 AND found GREATER most)
        set(most ${found})
        set(VORPIPE_TEST_PYTHON ${python})
      endif()
    endif()
  endforeach()
  message(STATUS "Python of the tests: ${VORPIPE_TEST_PYTHON}, with ${most} of ${all} modules")
endif()
