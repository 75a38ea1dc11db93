// Macros of Qt, X11, Arduino, Windows and macOS disturb no header that users include, and are there after it.
#define signals public
#define slots
#define emit
#define None 0L
#define Status int
#define Bool int
#define Success 0
#define check(x) x
#define verify(x) x
#define abs(x) ((x) > 0 ? (x) : -(x))
#define round(x) ((long)(x))
#define min(a, b) ((a) < (b) ? (a) : (b))
#define max(a, b) ((a) > (b) ? (a) : (b))
#define Complex 0
#define F(x) x
#include <kte/contacts.hpp>
#include <kte/control.hpp>
#include <kte/dynamics.hpp>
#include <kte/io.hpp>
#include <kte/kte.hpp>
#include <kte/loops.hpp>
#include <kte/manipulators.hpp>
#include <kte/robots.hpp>
#include <kte/shared_coordinates.hpp>
#include <kte/simulation.hpp>
#include <kte/static.hpp>
#include <kte/statics.hpp>
#include <kte/sweep.hpp>
#include <kte/view.hpp>

class counter {
 signals:
  Bool value = None;
};
static_assert(check(abs(-2)) == max(1, 2) && counter{}.value == Success);
