#include <kte/io/table_reader.hpp>
#include <kte/io/table_writer.hpp>

#include <bit>
#include <cstring>

#include "catch.hpp"
#include "scratch.hpp"

namespace npy_test {

using namespace kte;
using kte::test::scratch;

/// The format as numpy.lib.format in NumPy's documentation says it.

using names = std::vector<std::string>;

std::string little(std::uint64_t x, int bytes) {
  std::string s;
  for (int i = 0; i < bytes; ++i, x /= 256) s += static_cast<char>(static_cast<unsigned char>(x % 256));
  return s;
}
std::string doubles(const std::vector<double>& values) {
  std::string s;
  for (const double x : values) s += little(std::bit_cast<std::uint64_t>(x), 8);
  return s;
}
/// A file of version 1.0 with this dictionary.
std::string npy(const std::string& dictionary, const std::string& data = "") {
  return "\x93NUMPY" + std::string("\x01\x00", 2) + little(dictionary.size(), 2) + dictionary + data;
}

TEST_CASE("a file of NumPy is a padded dictionary and the bytes of the numbers") {
  scratch file(".npy");
  table_writer out(file.path, {"t", "tip/position/x"});
  out.row(0.5, -1.25);
  out.row(1, 1e300);
  out.close();
  const std::string dictionary =
      "{'descr': [('t', '<f8'), ('tip/position/x', '<f8')], 'fortran_order': False, 'shape': (2,), }";
  const std::string bytes = file.text(), data = doubles({0.5, -1.25, 1, 1e300});
  REQUIRE(bytes.size() > data.size());
  const std::size_t front = bytes.size() - data.size();
  CHECK(front % 64 == 0);
  CHECK(bytes.substr(front) == data);
  CHECK(bytes.substr(0, front) == npy(dictionary + std::string(front - 11 - dictionary.size(), ' ') + "\n"));
}

TEST_CASE("the number of rows is written over at each flush, and only there") {
  scratch file(".npy");
  table_writer out(file.path, {"t"});
  out.flush();
  std::string before = file.text();
  CHECK(before.find("'shape': (0,), }") != before.npos);
  for (int i = 0; i < 1234; ++i) out.row(i);
  out.flush();
  const std::string after = file.text();
  const auto at = after.find("'shape': (1234,), }");
  REQUIRE(at != after.npos);
  CHECK(after.size() == before.size() + 8 * 1234);
  CHECK(after.substr(0, at) == before.substr(0, at));
  CHECK(after[before.size() - 1] == '\n');
}

TEST_CASE("headers that are long or not ASCII are of version 3.0") {
  const auto version_of = [](const names& n) {
    scratch file(".npy");
    table_writer out(file.path, n);
    out.row(std::vector<double>(n.size(), 0.5));
    out.row(std::vector<double>(n.size(), 1.5));
    out.close();
    const table t = read_table(file.path);
    CHECK(t.names == n);
    for (const auto& c : t.columns) CHECK(c == std::vector<double>{0.5, 1.5});
    const std::string bytes = file.text();
    CHECK((bytes.size() - 16 * n.size()) % 64 == 0);
    return int{bytes[6]} * 10 + bytes[7];
  };
  CHECK(version_of({"t", "q"}) == 10);
  CHECK(version_of({"t", "winkel/\xc3\xa4"}) == 30);
  names many;
  for (int i = 0; i < 6000; ++i) many.push_back("q" + std::to_string(i));
  CHECK(version_of(many) == 30);
  // Around the 65535 bytes that version 1.0 can say, by one character a step.
  for (std::size_t n = 65300; n < 65600; n += 7) version_of({"t", std::string(n, 'x')});
}

TEST_CASE("rows that the header does not count are not read") {
  const std::string one = "{'descr': [('t', '<f8')], 'fortran_order': False, 'shape': (1,), }\n";
  scratch file(".npy", npy(one, doubles({7, 8}) + "cut"));
  CHECK(read_table(file.path)["t"] == std::vector<double>{7});
}

TEST_CASE("headers of version 2.0 say their length by four bytes") {
  const std::string header = "{'descr': [('t', '<f8')], 'fortran_order': False, 'shape': (1,), }\n";
  scratch file(".npy", "\x93NUMPY" + std::string("\x02\x00", 2) + little(header.size(), 4) + header + doubles({7}));
  CHECK(read_table(file.path)["t"] == std::vector<double>{7});
}

TEST_CASE("headers are padded to the next multiple of 64 bytes, not to the one after") {
  for (std::size_t n = 1; n <= 64; ++n) {
    const std::string name(n, 'x'), text = "{'descr': [('" + name + "', '<f8')], 'fortran_order': False, 'shape': (";
    scratch file(".npy");
    table_writer(file.path, {name}).close();
    CHECK(file.text().size() < 10 + text.size() + 25 + 1 + 64);  // 25: room for any number of rows
  }
}

TEST_CASE("blanks in a header do not matter") {
  scratch file(".npy", npy("{ 'descr' : [ ( 't' , '<f8' ) , ('q', '<f8'), ] , 'fortran_order' : False,\n"
                           "'shape':( 1, ) }",
                           doubles({7, 8})));
  const table t = read_table(file.path);
  CHECK(t["t"] == std::vector<double>{7});
  CHECK(t["q"] == std::vector<double>{8});
}

TEST_CASE("a forged or cut file is reported by offset, and needs no memory that it does not have") {
  const auto message = [](const std::string& bytes) {
    scratch file(".npy", bytes);
    return test::message_about<bad_file>(file, [&] { (void)read_table(file.path); });
  };
  const std::string front = "{'descr': [('t', '<f8'), ('q', '<f8')], 'fortran_order': False, 'shape': ";
  const std::string whole = npy(front + "(1,), }", doubles({1, 2}));
  CHECK(message(whole).empty());
  CHECK(message("") == "byte 0: not a file of NumPy");
  CHECK(message("t,q\n1,2\n") == "byte 0: not a file of NumPy");
  CHECK(message("\x93NUMPY\x01") == "byte 6: the version is cut off");
  CHECK(message("\x93NUMPY\x04" + std::string(20, '\0')) == "byte 8: expected version 1.0, 2.0 or 3.0");
  for (const std::string rows : {"2", "1152921504606846977", "18446744073709551615"}) {  // 2^60 + 1, 2^64 - 1
    const std::string forged = npy(front + "(" + rows + ",), }", doubles({1, 2}));
    CHECK(message(forged) == "byte " + std::to_string(forged.size() - 16) + ": " + rows +
                                 " rows of 16 bytes are announced, but only 16 bytes follow");
  }
  CHECK(message(npy(front + "(99999999999999999999,), }")).ends_with(": expected a number of rows"));
  CHECK(message(npy(front + "(-1,), }")).ends_with(": expected a number of rows"));
  CHECK(message(npy(front + "(1, 2), }", doubles({1, 2}))) == "byte 87: expected )");
  CHECK(message(npy("{'descr': '<f8', 'fortran_order': False, 'shape': (1,), }")) ==
        "byte 20: not a table: expected columns with names");
  CHECK(message(npy("{'descr': [('t', '<f4')], 'fortran_order': False, 'shape': (1,), }")) ==
        "byte 27: expected '<f8'");
  CHECK(message(npy("{'descr': [('t', '<f8')('q', '<f8')]")) == "byte 33: expected ]");
  CHECK(message(npy("{'descr': [('', '<f8')]")) == "byte 23: a column has no name");
  CHECK(message(npy("{'descr': [('t', '<f8'), ('t', '<f8')]")) == "byte 38: two columns are named 't'");
  CHECK(message(npy(front + "(1,), } 1", doubles({1, 2}))) == "byte 91: more than a header");
  CHECK(message(std::string("\x93NUMPY\x03\x00\xff\xff\xff\xff{", 13)) == "byte 12: the header is cut off");
  for (std::size_t n = 0; n < whole.size(); ++n) {
    CAPTURE(n);
    CHECK(!message(whole.substr(0, n)).empty());
  }
  for (std::size_t n = 0; n + 16 < whole.size(); ++n) {  // any byte of the header another one: an error or a table
    std::string forged = whole;
    forged[n] = static_cast<char>(forged[n] ^ 0x11);
    CAPTURE(n);
    CHECK_NOTHROW(message(forged));
  }
}

}  // namespace npy_test
