// mistakes: 2
// expect: error: .*kte: runtime chains need exceptions and RTTI; the headers of kte/static.hpp need neither
#include <kte/kte.hpp>
