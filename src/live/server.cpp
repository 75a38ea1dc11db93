#include "server.hpp"

#include <kte/errors.hpp>
#include <kte/io/text_table.hpp>

#include <charconv>
#include <fcntl.h>
#include <sys/socket.h>

#include "connection.hpp"

namespace kte::live {

namespace {
using httplib::Request, httplib::Response;

/// What every answer has: nothing is kept, nothing else may read it or show it in a frame, and the page reaches only
/// this server.
constexpr std::pair<const char*, const char*> headers[] = {
    {"Content-Security-Policy",
     "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval'; style-src 'unsafe-inline'; img-src data:; "
     "connect-src 'self'; form-action 'none'; base-uri 'none'; frame-ancestors 'none'"},
    {"Cache-Control", "no-store"},
    {"Referrer-Policy", "no-referrer"},
    {"X-Content-Type-Options", "nosniff"},
    {"X-Frame-Options", "DENY"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"Cross-Origin-Opener-Policy", "same-origin"},
};

void say(Response& out, int status, const std::string& text) {
  out.status = status;
  out.set_content("kte: " + text + "\n", "text/plain; charset=utf-8");
}

/// A whole text as a number.
template <class Number>
std::optional<Number> number_of(const Request& in, const char* name) {
  if (in.get_param_value_count(name) != 1) return std::nullopt;
  const auto text = in.get_param_value(name);
  Number x{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return x;
}

/// Connections are only handed over, in the thread that accepts them.
struct at_once : httplib::TaskQueue {
  void enqueue(std::function<void()> task) override { task(); }
  void shutdown() override {}
};
}  // namespace

server::server(session& s, std::string page, std::vector<std::string> columns, int port)
    : session_(s), page_(std::move(page)), columns_(names_in_table(columns)) {
  socket_t listening = -1;
  set_socket_options([&listening](socket_t socket) {
    listening = socket;
    const int yes = 1, bytes = 1 << 16;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    ::setsockopt(socket, SOL_SOCKET, SO_SNDBUF, &bytes, sizeof bytes);  // so that what waits for a slow page is not old
    ::fcntl(socket, F_SETFD, FD_CLOEXEC);
  });
  set_tcp_nodelay(true);
  new_task_queue = [] { return new at_once; };
  set_pre_routing_handler([this](const Request& in, Response& out) {
    answer(in, out);
    return HandlerResponse::Handled;
  });
  const char* const local = "127.0.0.1";
  const int wanted = port;
  if (port == 0)
    port = bind_to_any_port(local);
  else if (!bind_to_port(local, port))
    port = -1;
  if (port < 0)
    detail::raise<bad_argument>(
        "kte: a live page cannot listen at " +
        (wanted == 0 ? "127.0.0.1"
                     : "port " + std::to_string(wanted) + " of 127.0.0.1: another program does, or it is not allowed"));
  ::listen(listening, SOMAXCONN);  // more than the library asks for
  const auto number = ':' + std::to_string(port);
  hosts_ = {local + number, "localhost" + number};
  url_ = "http://" + hosts_[0] + '/' + token_ + '/';
  thread_ = std::thread([this] { listen_after_bind(); });
  while (!is_running()) std::this_thread::yield();  // who stops before it listens waits for ever
}

server::~server() {
  session_.close();
  stop();
  thread_.join();
}

bool server::process_and_close_socket(socket_t socket) {
  ::fcntl(socket, F_SETFD, FD_CLOEXEC);
  heads_.add(socket);
  return true;
}

void server::process(int socket, std::string head) {
  connection c(socket, std::move(head), [this] { return session_.closed(); });
  bool closed = false;
  process_request(c, true, closed, [](Request& in) {
    in.headers.erase("Accept-Encoding");  // answers are not compressed, which takes longer than sending them
    in.ranges.clear();
  });
}

std::string server::refusal(const Request& in) const {
  const auto is_here = [this](std::string_view host) {
    return std::find(hosts_.begin(), hosts_.end(), host) != hosts_.end();
  };
  if (in.get_header_value_count("Host") != 1 || !is_here(in.get_header_value("Host")))
    return "this server is " + hosts_[0] + " and has no other name";
  for (std::size_t i = 0; i < in.get_header_value_count("Origin"); ++i) {
    const auto origin = in.get_header_value("Origin", i);
    if (!origin.starts_with("http://") || !is_here(std::string_view(origin).substr(7)))
      return "requests of other pages are refused";
  }
  const auto token = std::string_view(in.path).substr(0, 1 + token_.size());
  if (!same_token('/' + token_, token) || in.path.size() == token.size() || in.path[token.size()] != '/')
    return "the address differs from that which the program has printed: its token is missing or wrong";
  return {};
}

void server::answer(const Request& in, Response& out) {
  for (const auto& [name, value] : headers) out.set_header(name, value);
  if (const auto why = refusal(in); !why.empty()) return say(out, 403, why);
  const auto what = in.path.substr(std::min(in.path.size(), token_.size() + 2));
  if (in.method == "GET") return get(what, out);
  if (in.method == "POST") return post(what, in, out);
  say(out, 405, "there are GET and POST");
}

void server::get(const std::string& what, Response& out) {
  if (what.empty()) return out.set_content(page_, "text/html; charset=utf-8");
  if (what == "events") return send_events(out);
  if (what == "recording.csv") return send_recording(out);
  say(out, 404, "there is nothing here");
}

void server::post(const std::string& what, const Request& in, Response& out) {
  out.status = 204;
  if (what == "pause") return session_.pause(true);
  if (what == "run") return session_.pause(false);
  if (what == "step") return session_.step();
  if (what == "reset") return session_.reset();
  if (what == "record") return session_.record(true);
  if (what == "keep") return session_.record(false);
  if (what == "release") return session_.release();
  if (what != "slider" && what != "speed" && what != "pull") return say(out, 404, "there is nothing here");
  if (!set_numbers(what, in))
    say(out, 400,
        "there is no such " + std::string(what == "pull" ? "frame" : "slider") + ", or a number is out of its limits");
}
bool server::set_numbers(const std::string& what, const Request& in) {
  if (what == "pull") {
    const auto frame = number_of<std::size_t>(in, "frame");
    double x[6];
    std::size_t n = 0;
    for (const char* const name : {"x", "y", "z", "to_x", "to_y", "to_z"}) {
      const auto value = number_of<double>(in, name);
      if (!value) return false;
      x[n++] = *value;
    }
    return frame && session_.pull(*frame, {x[0], x[1], x[2]}, {x[3], x[4], x[5]});
  }
  const auto value = number_of<double>(in, "value");
  if (what == "speed") return value && session_.set_speed(*value);
  const auto index = number_of<std::size_t>(in, "index");
  return value && index && session_.set_slider(*index, *value);
}

void server::send_events(Response& out) {
  const auto page = session_.open_page();
  if (!page) return say(out, 503, std::to_string(session::most_pages) + " pages are open already");
  out.set_chunked_content_provider("text/event-stream", [page](std::size_t, httplib::DataSink& to) {
    const auto news = page->next();
    const auto text = events_of(news);
    if (!to.is_writable() || !to.write(text.data(), text.size())) return false;
    if (news.end) to.done();
    return true;
  });
}

void server::send_recording(Response& out) {
  out.set_header("Content-Disposition", "attachment; filename=\"recording.csv\"");
  struct reader {
    recording_rows rows;
    std::size_t next = 0;
    detail::text_table table{','};
  };
  const auto all = std::make_shared<reader>(reader{session_.recorded()});
  out.set_chunked_content_provider("text/csv; charset=utf-8", [all, this](std::size_t, httplib::DataSink& to) {
    std::string text;
    if (all->next == 0) all->table.head(columns_, text);
    constexpr std::size_t bytes = 1 << 16;
    for (; all->next < all->rows.rows() && text.size() < bytes; ++all->next)
      all->table.row(all->rows.row(all->next), text);
    if (!to.write(text.data(), text.size())) return false;
    if (all->next == all->rows.rows()) to.done();
    return true;
  });
}

}  // namespace kte::live
