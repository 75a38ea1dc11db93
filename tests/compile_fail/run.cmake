# cmake -D FILE=x.cpp -D COMPILER=GNU|Clang -P run.cmake -- COMPILER FLAGS...
#
# Comments in x.cpp say what must happen:
#   // expect: REGEX      it does not compile, and the output matches; any number of these
#   // lines: N           by g++, the output has fewer than N lines
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
if(COMPILER STREQUAL GNU AND text MATCHES "// lines: ([0-9]+)")
  set(limit ${CMAKE_MATCH_1})
  string(REGEX MATCHALL "\n" newlines "${output}")
  list(LENGTH newlines lines)
  if(NOT lines LESS limit)
    message(SEND_ERROR "${lines} lines of output, not fewer than ${limit}")
  endif()
endif()
