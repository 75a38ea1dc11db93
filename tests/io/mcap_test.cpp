#include <kte/io/table_reader.hpp>
#include <kte/io/table_writer.hpp>

#include <cmath>
#include <limits>
#include <map>

#include "catch.hpp"
#include "scratch.hpp"

namespace mcap_test {

using namespace kte;
using kte::test::scratch;

/// A file of MCAP taken apart after its specification, mcap.dev/spec, by itself: nothing of the library is used.
struct mcap_file {
  struct record {
    int op;
    std::string content;
  };
  std::string begin, end;  ///< the bytes around the records
  std::vector<record> records;

  explicit mcap_file(const std::string& bytes) {
    begin = bytes.substr(0, 8);
    std::size_t at = 8;
    while (bytes.size() - at >= 9) {
      const std::uint64_t n = number(bytes, at + 1, 8);
      REQUIRE(n <= bytes.size() - at - 9);
      records.push_back({static_cast<unsigned char>(bytes[at]), bytes.substr(at + 9, n)});
      at += 9 + n;
    }
    end = bytes.substr(at);
  }
  static std::uint64_t number(const std::string& s, std::size_t at, std::size_t bytes) {
    std::uint64_t x = 0;
    while (bytes-- > 0) x = 256 * x + static_cast<unsigned char>(s.at(at + bytes));
    return x;
  }
  /// Fields of a content by their types: 2, 4, 8 are numbers of 2, 4, 8 bytes, s is a text with its length before it, m
  /// a map of name_list, r the rest.
  static std::vector<std::string> fields(const std::string& content, const std::string& types) {
    std::vector<std::string> r;
    std::size_t at = 0;
    const auto text = [&] {
      const auto n = number(content, at, 4);
      at += 4 + n;
      REQUIRE(at <= content.size());
      return content.substr(at - n, n);
    };
    for (const char t : types) {
      if (t == 's') {
        r.push_back(text());
      } else if (t == 'm') {
        const std::string map = text();
        at -= map.size();
        const std::size_t stop = at + map.size();
        while (at < stop) r.push_back(text());
      } else if (t == 'r') {
        r.push_back(content.substr(at));
        at = content.size();
      } else {
        r.push_back(std::to_string(number(content, at, static_cast<std::size_t>(t - '0'))));
        at += static_cast<std::size_t>(t - '0');
      }
    }
    CHECK(at == content.size());
    return r;
  }
};
const std::string magic = "\x89MCAP0\r\n";
using name_list = std::vector<std::string>;

TEST_CASE("a file of MCAP has the records of its specification") {
  scratch file(".mcap");
  table_writer out(file.path, {"t", "q", "tip/position/x"});
  out.row(0.0, 1, -1e-17);
  out.row(0.1, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity());
  out.row(123456.5, std::numeric_limits<double>::quiet_NaN(), 0.1);
  out.close();

  const mcap_file f(file.text());
  CHECK(f.begin == magic);
  CHECK(f.end == magic);
  const auto fields = [&f](std::size_t i, int op, const std::string& types) {
    REQUIRE(i < f.records.size());
    CHECK(f.records[i].op == op);
    return mcap_file::fields(f.records[i].content, types);
  };
  REQUIRE(f.records.size() == 8);
  CHECK(fields(0, 1, "ss") == name_list{"", "kte"});  // profile, library
  CHECK(fields(1, 3, "2sss") ==                       // id, name, encoding, data
        name_list{"1", "kte.table", "jsonschema",
                  R"({"type":"object","properties":{"t":{"type":"number"},"q":{"type":"number"},)"
                  R"("tip/position/x":{"type":"number"}}})"});
  CHECK(fields(2, 4, "22ssm") ==  // id, schema, topic, encoding, metadata
        name_list{"1", "1", "/kte", "json", "columns", "t q tip/position/x"});
  const std::string message = "2488r";  // channel, sequence, logged, published, data
  CHECK(fields(3, 5, message) == name_list{"1", "0", "0", "0", R"({"t":0.0,"q":1.0,"tip/position/x":-1e-17})"});
  CHECK(fields(4, 5, message) ==
        name_list{"1", "1", "100000000", "100000000", R"({"t":0.1,"q":"Infinity","tip/position/x":"-Infinity"})"});
  CHECK(fields(5, 5, message) ==
        name_list{"1", "2", "123456500000000", "123456500000000", R"({"t":123456.5,"q":"NaN","tip/position/x":0.1})"});
  CHECK(fields(6, 15, "4") == name_list{"0"});             // no check sum
  CHECK(fields(7, 2, "884") == name_list{"0", "0", "0"});  // no summary
}

TEST_CASE("times of a message are whole nanoseconds, or an error that leaves the table unchanged") {
  scratch file(".mcap");
  table_writer out(file.path, {"t"});
  out.row(1e-9);
  out.row(1.001);  // times 1e9 it is 1000999999.9999999
  for (const double t : {-1e-9, 9.1e9, std::numeric_limits<double>::quiet_NaN()})
    CHECK_THROWS_AS(out.row(t), bad_argument);
  CHECK(test::message_of<bad_argument>([&] { out.row(-1); }) ==
        "kte: the first column of an MCAP table is time, from 0 to 9000000000 s, got -1");
  out.row(2), out.row(9e9);
  out.close();
  CHECK(read_table(file.path)["t"] == std::vector<double>{1e-9, 1.001, 2, 9e9});
  const mcap_file f(file.text());
  CHECK(mcap_file::number(f.records[3].content, 6, 8) == 1);
  CHECK(mcap_file::number(f.records[4].content, 6, 8) == 1001000000);
  CHECK(mcap_file::number(f.records[5].content, 2, 4) == 2);
}

std::string little(std::uint64_t x, int bytes) {
  std::string s;
  for (int i = 0; i < bytes; ++i, x /= 256) s += static_cast<char>(static_cast<unsigned char>(x % 256));
  return s;
}
std::string text(const std::string& s) { return little(s.size(), 4) + s; }
std::string record(int op, const std::string& content) {
  return static_cast<char>(op) + little(content.size(), 8) + content;
}
std::string channel(int id, const std::string& key, const std::string& columns) {
  return record(4, little(static_cast<std::uint64_t>(id), 2) + little(0, 2) + text("/x") + text("json") +
                       text(text(key) + text(columns)));
}
std::string message(int id, const std::string& json) {
  return record(5, little(static_cast<std::uint64_t>(id), 2) + std::string(20, '\0') + json);
}

TEST_CASE("other records, channels and a missing end do not matter") {
  const std::string bytes = magic + record(1, text("") + text("other")) + record(12, text("metadata") + text("")) +
                            channel(5, "robot", "arm") + message(5, "{}") + channel(7, "columns", "t q") +
                            message(7, R"({"t":0,"q":-1E2})") + message(5, "?") + record(200, "private") +
                            message(7, R"({"t":1,"q":"NaN"})");
  scratch file(".mcap", bytes);
  const auto check = [&file] {
    const table t = read_table(file.path);
    CHECK(t.names == name_list{"t", "q"});
    CHECK(t["t"] == std::vector<double>{0, 1});
    CHECK(t["q"][0] == -100);
  };
  check();
  file.write(bytes + record(15, little(0, 4)));
  check();
  file.write(bytes + record(15, little(0, 4)) + record(2, std::string(20, '\0')) + magic);
  check();
}

TEST_CASE("a forged or cut file is reported by offset and column, and needs no memory that it does not have") {
  const auto error = [](const std::string& bytes) {
    scratch file(".mcap", bytes);
    return test::message_about<bad_file>(file, [&] { (void)read_table(file.path); });
  };
  const std::string front = magic + channel(1, "columns", "t q");
  const auto at = [&front](std::size_t more, const std::string& what) {
    return "byte " + std::to_string(front.size() + more) + ": " + what;
  };
  CHECK(error(front).empty());
  CHECK(error("") == "byte 0: expected " + magic);
  CHECK(error("t,q\n") == "byte 0: expected " + magic);
  CHECK(error(magic) == "byte 8: no channel of MCAP that holds a table");
  CHECK(error(magic + channel(1, "columns", "t q t")).ends_with(": the list of columns has 't' twice"));
  CHECK(error(magic + channel(1, "columns", "t  q")).ends_with(": the list of columns has an empty name"));
  CHECK(error(front + "\x05") == at(1, "the length of a record is cut off"));
  CHECK(error(front + "\x05" + std::string(8, '\xff') + "x") == at(9, "a record is cut off"));
  CHECK(error(front + record(5, "x")) == at(9, "a message is cut off"));
  CHECK(error(front + record(4, std::string(4, '\0') + std::string(4, '\xff'))) == at(17, "a topic is cut off"));
  CHECK(error(front + record(4, std::string(12, '\0') + std::string(4, '\xff'))) == at(25, "metadata is cut off"));
  CHECK(error(front + record(6, "x")) == at(9, "a chunk of MCAP: only files without chunks are read"));
  const auto end = record(15, little(0, 4)) + record(2, std::string(20, '\0')) + magic;
  CHECK(error(front + end).empty());
  CHECK(error(front + end + "x").ends_with("a record is cut off"));
  const auto row = [&](const std::string& json) { return error(front + message(1, json)); };
  CHECK(row(R"({"t":1,"q":2})").empty());
  CHECK(row(R"({"t":1,"q":2x})") == at(42, "column 2: '2x' is not a number"));
  CHECK(row(R"({"t":1,"q":})") == at(42, "column 2: '' is not a number"));
  CHECK(row(R"({"t":1,"q":"7"})") == at(42, "column 2: '7' is not a number"));
  CHECK(row(R"({"t":1,"q":null})") == at(42, "column 2: 'null' is not a number"));
  CHECK(row(R"({"t":1,"q":1e999})") == at(42, "column 2: '1e999' is not a number"));
  CHECK(row(R"({"t":1,"v":2})") == at(39, "expected q"));
  CHECK(row(R"({"t":1})") == at(37, "expected ,\""));
  CHECK(row(R"({"t":1,"q":2,"v":3})") == at(43, "expected }"));
  CHECK(row(R"({"t":1,"q":2} )") == at(44, "more than a row"));
  CHECK(row(R"({"t":1,"q":2)") == at(42, "cut off"));
  CHECK(row("") == at(31, "expected {\""));

  scratch file(".mcap");
  table_writer out(file.path, {"t", "q"});
  out.row(0, 1), out.row(1, 2);
  out.close();
  const std::string whole = file.text();
  for (std::size_t n = 0; n < whole.size(); ++n) {  // cut anywhere, or any byte another one: an error or a table
    CAPTURE(n);
    CHECK_NOTHROW(error(whole.substr(0, n)));
    std::string forged = whole;
    forged[n] = static_cast<char>(forged[n] ^ 0x11);
    CHECK_NOTHROW(error(forged));
  }
}

}  // namespace mcap_test
