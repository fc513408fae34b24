#include "cli/view/server.hpp"

#include <csignal>
#include <memory>
#include <random>
#include <thread>

#include <fmt/format.h>
#include <httplib.h>
#include <nlohmann/json.hpp>

#include "cli/report/assets.hpp"
#include "cli/shell_words.hpp"
#include "description/diagnostics.hpp"
#include "events/simulation_failure.hpp"

namespace wormdrive {
namespace {

constexpr std::size_t longest_request = 65536;  ///< bytes: some hundred sliders
constexpr int patience = 5;                     ///< for a request to arrive [s]

std::string random_token() {
  std::random_device source;  // the system's own generator, which cannot be foreseen
  std::string token;
  for (int word = 0; word < 4; ++word) token += fmt::format("{:08x}", source() & 0xffffffffu);
  return token;
}

nlohmann::ordered_json as_json(const Slider& s) {
  return {
      {"key", s.quantity.name}, {"unit", s.quantity.unit}, {"meaning", s.quantity.meaning}, {"value", s.quantity.value},
      {"low", s.low},           {"high", s.high}};
}

std::string page_html(Viewer& viewer) {
  nlohmann::ordered_json view{{"command", "wormdrive run " + shell_path(viewer.file())},
                              {"sliders", nlohmann::ordered_json::array()}};
  for (const std::string& one : viewer.overrides())
    view["command"] = view["command"].get<std::string>() + " --set " + shell_word(one);
  for (const Slider& s : viewer.sliders()) view["sliders"].push_back(as_json(s));
  return to_html(
      viewer.page({}),
      {fmt::format("<style>{}</style>\n<section id=\"view\" aria-label=\"parameters\"></section>\n", assets::view_css),
       fmt::format("<script type=\"application/json\" id=\"sliders\">{}</script>\n<script>{}</script>\n",
                   embedded(view), assets::view_js)});
}

/// The values in a request: numbers of sliders, and of nothing else. Throws InputFault.
std::map<std::string, double> values_in(const std::string& body, const std::vector<Slider>& sliders) {
  const nlohmann::ordered_json asked = nlohmann::ordered_json::parse(body, nullptr, false);
  if (!asked.is_object()) reject({"request"}, "is not a JSON object of keys and numbers");
  std::map<std::string, double> values;
  for (const auto& [key, value] : asked.items()) {
    const bool known = std::any_of(sliders.begin(), sliders.end(),
                                   [&, &name = key](const Slider& s) { return s.quantity.name == name; });
    if (!known || !value.is_number()) reject({"request"}, "names what is no slider, or gives it no number");
    values[key] = value.get<double>();
  }
  return values;
}

/// Sends a text as it is: the library would compress it for a browser, which takes ten times as long as the run.
void send(httplib::Response& to, std::string text, const char* type) {
  const auto body = std::make_shared<const std::string>(std::move(text));
  to.set_content_provider(body->size(), type, [body](std::size_t begin, std::size_t length, httplib::DataSink& sink) {
    return sink.write(body->data() + begin, length);
  });
}
void answer(httplib::Response& to, int status, const std::string& message) {
  to.status = status;
  send(to,
       nlohmann::ordered_json{{"message", message}}.dump(-1, ' ', false,
                                                         nlohmann::ordered_json::error_handler_t::replace),
       "application/json");
}

void answer_run(Viewer& viewer, const httplib::Request& asked, httplib::Response& to) {
  constexpr int not_processable = 422, conflict = 409, failed = 500;
  try {
    send(to, to_json(viewer.page(values_in(asked.body, viewer.sliders()))), "application/json");
  } catch (const InputFault& fault) {
    answer(to, not_processable, fault.what());
  } catch (const SimulationFailure& halt) {
    answer(to, not_processable, halt.what());
  } catch (const Superseded& later) {
    answer(to, conflict, later.what());
  } catch (const std::exception& error) {
    answer(to, failed, error.what());
  }
}

/// Ends the server when the program is told to end. Made before any thread, so that no other one is told.
class EndOnSignal {
 public:
  explicit EndOnSignal(std::function<void()> end) : end_(std::move(end)) {
    sigemptyset(&signals_);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals_, signal);
    pthread_sigmask(SIG_BLOCK, &signals_, &before_);
    waits_ = std::thread([this] {
      int which = 0;
      sigwait(&signals_, &which);
      end_();
    });
  }
  EndOnSignal(const EndOnSignal&) = delete;
  EndOnSignal& operator=(const EndOnSignal&) = delete;
  ~EndOnSignal() {
    pthread_kill(waits_.native_handle(), SIGTERM);  // where nobody did
    waits_.join();
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

 private:
  std::function<void()> end_;
  sigset_t signals_{}, before_{};
  std::thread waits_;
};

}  // namespace

void serve(Viewer& viewer, int port, const std::function<void(const std::string& address)>& opened) {
  httplib::Server server;
  server.set_payload_max_length(longest_request);
  server.set_read_timeout(patience);
  server.set_keep_alive_timeout(patience);
  server.set_tcp_nodelay(true);  // an answer goes out at once, not 40 ms later
  const std::string path = "/" + random_token() + "/";
  std::string host;
  // a page of another origin may neither ask under a name of its own nor have its browser ask
  server.set_pre_routing_handler([&](const httplib::Request& asked, httplib::Response& to) {
    to.set_header("Cache-Control", "no-store");
    to.set_header("X-Content-Type-Options", "nosniff");
    to.set_header("Referrer-Policy", "no-referrer");
    to.set_header("Content-Security-Policy",
                  "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:; "
                  "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
    const std::string origin = asked.get_header_value("Origin");
    if (asked.get_header_value("Host") == host && (origin.empty() || origin == "http://" + host) &&
        asked.path.starts_with(path))
      return httplib::Server::HandlerResponse::Unhandled;
    answer(to, 404, "not found");
    return httplib::Server::HandlerResponse::Handled;
  });
  server.Get(path, [&](const httplib::Request&, httplib::Response& to) {
    try {
      send(to, page_html(viewer), "text/html; charset=utf-8");
    } catch (const std::exception& error) {
      answer(to, 500, error.what());
    }
  });
  server.Post(path + "run",
              [&](const httplib::Request& asked, httplib::Response& to) { answer_run(viewer, asked, to); });

  const bool bound =
      port == 0 ? (port = server.bind_to_any_port("127.0.0.1")) > 0 : server.bind_to_port("127.0.0.1", port);
  if (!bound) reject({fmt::format("--port {}", port)}, "another program has it; 0 takes any that is free");
  host = fmt::format("127.0.0.1:{}", port);
  const EndOnSignal end([&] {
    viewer.give_up();
    server.stop();
  });
  opened("http://" + host + path);
  server.listen_after_bind();
}

}  // namespace wormdrive
