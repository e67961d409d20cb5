cmake_minimum_required(VERSION 3.25)

# Compiles SOURCE twice with the command COMPILE, and wants both answers:
#   -DGNOMON_EXPECT_FAILURE=0 compiles, so the file has no other reason to fail;
#   -DGNOMON_EXPECT_FAILURE=1 does not, and says what the file's first line expects within the first errors.
# The file begins with `// expect: REGEX` (CMake's), and may go on with `// flags: ...` for both runs.
file(STRINGS ${SOURCE} _head LIMIT_COUNT 2)
set(_expect)
set(_flags)
foreach(_line IN LISTS _head)
  if(_line MATCHES "^// expect: (.+)$")
    set(_expect "${CMAKE_MATCH_1}")
  elseif(_line MATCHES "^// flags: (.+)$")
    separate_arguments(_flags UNIX_COMMAND "${CMAKE_MATCH_1}")
  endif()
endforeach()
if(NOT _expect)
  message(FATAL_ERROR "${SOURCE}: the first line must be `// expect: REGEX`")
endif()

foreach(_fail 0 1)
  execute_process(COMMAND ${COMPILE} ${_flags} -fsyntax-only -DGNOMON_EXPECT_FAILURE=${_fail} ${SOURCE}
                  RESULT_VARIABLE _result OUTPUT_VARIABLE _output ERROR_VARIABLE _output)
  if(_fail EQUAL 0 AND NOT _result EQUAL 0)
    message(FATAL_ERROR "${SOURCE}: without its mistake it must compile, but:\n${_output}")
  elseif(_fail EQUAL 1 AND _result EQUAL 0)
    message(FATAL_ERROR "${SOURCE}: it must not compile, but does")
  endif()
endforeach()

# A message far down is a message nobody reads.
string(REGEX MATCHALL "[^\n]+" _lines "${_output}")
list(LENGTH _lines _count)
if(_count GREATER 40)
  list(SUBLIST _lines 0 40 _lines)
endif()
list(JOIN _lines "\n" _top)
if(NOT _top MATCHES "${_expect}")
  message(FATAL_ERROR "${SOURCE}: its first 40 lines of errors must match \"${_expect}\", but are:\n${_top}")
endif()
