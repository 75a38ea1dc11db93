# cmake -D FILE=x.cpp -D COMPILER=GNU|Clang -P run.cmake -- COMPILER FLAGS...
#
# Comments in x.cpp say what must happen:
#   // expect: REGEX      it does not compile, and the output matches; any number of these
#   // mistakes: N        there are N errors; 1 where nothing is said
#   // expect-success     it does compile: without a control, a wrong flag would pass all cases
cmake_minimum_required(VERSION 3.25)
set(command)
foreach(i RANGE ${CMAKE_ARGC})
  if(DEFINED after_dashes)
    list(APPEND command ${CMAKE_ARGV${i}})
  elseif("${CMAKE_ARGV${i}}" STREQUAL "--")
    set(after_dashes TRUE)
  endif()
endforeach()
if(COMPILER STREQUAL Clang)
  list(APPEND command -ferror-limit=0)  # all mistakes of a file, not the first twenty
endif()
# Code is generated: without, g++ leaves some templates alone.
execute_process(COMMAND ${CMAKE_COMMAND} -E env LC_ALL=C ${command} -S -o /dev/null ${FILE}
  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
message("${output}")

file(READ ${FILE} text)
string(REGEX MATCHALL "// expect: [^\n]+" expectations "${text}")
if(text MATCHES "// expect-success")
  if(result)
    message(FATAL_ERROR "must compile, but does not")
  endif()
  return()
elseif(NOT expectations)
  message(FATAL_ERROR "says nothing about what to expect")
elseif(NOT result)
  message(FATAL_ERROR "must not compile, but does")
endif()
foreach(expectation IN LISTS expectations)
  string(REPLACE "// expect: " "" expectation "${expectation}")
  if(NOT output MATCHES "${expectation}")
    message(SEND_ERROR "the compiler does not say: ${expectation}")
  endif()
endforeach()
# A mistake is one error, and no error is longer than a window of a terminal shows at once. clang counts them at the end.
set(mistakes 1)
if(text MATCHES "// mistakes: ([0-9]+)")
  set(mistakes ${CMAKE_MATCH_1})
endif()
string(REGEX REPLACE "[0-9]+ errors? generated\\.\n" "" output "${output}")
string(REGEX MATCHALL " error: " errors "${output}")
string(REGEX MATCHALL "\n" newlines "${output}")
list(LENGTH errors count)
list(LENGTH newlines lines)
math(EXPR limit "15 * ${mistakes}")
if(NOT count EQUAL mistakes)
  message(SEND_ERROR "${count} errors for ${mistakes} mistakes")
endif()
if(lines GREATER limit)
  message(SEND_ERROR "${lines} lines of output, more than ${limit}")
endif()
