// SPDX-License-Identifier: MIT
#include "browser.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "base64.hpp"
#include "browser_process.hpp"
#include "kinefile/io.hpp"
#include "signals.hpp"

namespace kinefile::cli {
namespace {

using Message = nlohmann::json;

constexpr std::array<const char*, 4> kBrowsers = {"chromium", "chromium-browser", "google-chrome",
                                                  "google-chrome-stable"};
constexpr auto kTimeLimit = std::chrono::seconds(120);

bool is_program(const std::string& path) {
  std::error_code fault;
  return std::filesystem::is_regular_file(path, fault) && ::access(path.c_str(), X_OK) == 0;
}

/// The path of the first browser of the list that is on the path.
Result<std::string> find_browser() {
  const char* const variable = std::getenv("PATH");
  const std::string folders = variable == nullptr ? "" : variable;
  for (const char* const name : kBrowsers) {
    for (std::size_t at = 0; at < folders.size();) {
      const std::size_t end = std::min(folders.find(':', at), folders.size());
      const std::string path = fmt::format("{}/{}", folders.substr(at, end - at), name);
      if (end > at && is_program(path)) return path;
      at = end + 1;
    }
  }
  return fail(ErrorKind::Io, "PAG002",
              fmt::format("expected a browser that makes the picture on the path ({}), found "
                          "none; install Chromium (Debian: apt install chromium)",
                          fmt::join(kBrowsers, ", ")));
}

/// The words that start a browser without a window, a profile or a network of its own.
std::vector<std::string> browser_words(const Picture& picture, const std::string& profile) {
  std::vector<std::string> words = {
      "--headless",
      "--disable-gpu",
      "--disable-quic",
      "--no-first-run",
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-sync",
      "--disable-breakpad",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      "--remote-debugging-pipe",
      "--user-data-dir=" + profile,
      fmt::format("--window-size={},{}", picture.width, picture.height)};
  if (::geteuid() == 0) words.emplace_back("--no-sandbox");  // Chromium makes none for root
  words.emplace_back("about:blank");
  return words;
}

/// The address of a file with an absolute path.
std::string file_address(const std::string& path) {
  constexpr std::string_view kPlain = "-._~/";
  std::string address = "file://";
  for (const char c : path) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    const bool is_plain = is_letter || (c >= '0' && c <= '9') || kPlain.find(c) != kPlain.npos;
    address += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return address;
}

/// The text at a place of a message; empty if there is none.
std::string text_at(const Message& message, const char* place) {
  const Message::json_pointer pointer(place);
  if (!message.contains(pointer) || !message[pointer].is_string()) return {};
  return message[pointer].get<std::string>();
}

Error page_failed(const std::string& words) {
  return make_error(ErrorKind::Io, "PAG004",
                    fmt::format("expected a picture from the page, found: {}", words));
}

/// A page of a browser, by the browser's own protocol (Chrome DevTools Protocol).
class BrowserPage {
 public:
  BrowserPage(BrowserProcess& browser, Deadline deadline)
      : browser_(browser), deadline_(deadline) {}

  /// Makes an empty page.
  Result<void> open() {
    auto target = call("Target.createTarget", {{"url", "about:blank"}});
    if (!target) return fail(std::move(target.error()));
    auto attached = call("Target.attachToTarget",
                         {{"targetId", text_at(*target, "/result/targetId")}, {"flatten", true}});
    if (!attached) return fail(std::move(attached.error()));
    session_ = text_at(*attached, "/result/sessionId");
    auto enabled = call("Inspector.enable", Message::object());
    if (enabled) enabled = call("Page.enable", Message::object());
    if (enabled) enabled = call("Page.setLifecycleEventsEnabled", {{"enabled", true}});
    return enabled ? Result<void>() : fail(std::move(enabled.error()));
  }

  /// Loads an address, scripts included.
  Result<void> load(const std::string& address) {
    auto answer = call("Page.navigate", {{"url", address}});
    if (!answer) return fail(std::move(answer.error()));
    const std::string fault = text_at(*answer, "/result/errorText");
    if (!fault.empty()) return fail(page_failed(fault));
    // The empty page may tell only now that it was loaded; its loader is another.
    const std::string loader = text_at(*answer, "/result/loaderId");
    while (!loaded_.contains(loader)) {
      auto message = receive();
      if (!message) return fail(std::move(message.error()));
    }
    return {};
  }

  /// The text that an expression, or its promise, gives.
  Result<std::string> evaluate(const std::string& expression) {
    auto answer =
        call("Runtime.evaluate",
             {{"expression", expression}, {"awaitPromise", true}, {"returnByValue", true}});
    if (!answer) return fail(std::move(answer.error()));
    if (answer->contains(Message::json_pointer("/result/exceptionDetails"))) {
      return fail(page_failed(words_of_exception(*answer)));
    }
    return text_at(*answer, "/result/result/value");
  }

 private:
  /// Sends a command and waits for its answer.
  Result<Message> call(const char* method, const Message& parameters) {
    Message command = {{"id", ++num_calls_}, {"method", method}, {"params", parameters}};
    if (!session_.empty()) command["sessionId"] = session_;
    if (auto sent = browser_.send(command.dump()); !sent) return fail(std::move(sent.error()));
    while (true) {
      auto message = receive();
      if (!message) return message;
      if (!message->contains("id") || (*message)["id"] != num_calls_) continue;
      if (!message->contains("error")) return message;
      return fail(page_failed(text_at(*message, "/error/message")));
    }
  }

  /// The next message. If it tells that something was loaded, this is noted; if the page crashed,
  /// that is the error.
  Result<Message> receive() {
    auto text = browser_.receive(deadline_);
    if (!text) return fail(std::move(text.error()));
    Message message = Message::parse(*text, nullptr, false);
    const std::string method = text_at(message, "/method");
    if (method == "Inspector.targetCrashed") {
      return fail(page_failed("a crash; the page may need more memory than there is"));
    }
    const bool is_load = text_at(message, "/params/name") == "load";
    if (method == "Page.lifecycleEvent" && is_load)
      loaded_.insert(text_at(message, "/params/loaderId"));
    return message;
  }

  /// What an exception says, without the places in the page's script.
  static std::string words_of_exception(const Message& answer) {
    for (const char* const place : {"/result/exceptionDetails/exception/description",
                                    "/result/exceptionDetails/exception/value"}) {
      const std::string words = text_at(answer, place);
      if (!words.empty()) return words.substr(0, words.find("\n    at "));
    }
    return text_at(answer, "/result/exceptionDetails/text");
  }

  BrowserProcess& browser_;
  Deadline deadline_;
  std::string session_;
  std::set<std::string> loaded_;  ///< the loaders that have loaded their page
  int num_calls_ = 0;
};

std::string expression_of(const Picture& picture) {
  const Message options = {
      {"width", picture.width},
      {"height", picture.height},
      {"frames", picture.frames.empty() ? Message() : Message(picture.frames)}};
  return fmt::format("globalThis.kinefile.picture({})", options.dump());
}

/// Loads the address in a browser and takes the picture's base64.
/// \param folder  for the browser's own files
Result<std::string> ask_for_picture(const std::string& program, const std::string& folder,
                                    const std::string& address, const Picture& picture) {
  auto browser =
      BrowserProcess::start(program, browser_words(picture, folder + "/profile"), folder);
  if (!browser) return fail(std::move(browser.error()));
  BrowserPage page(*browser, std::chrono::steady_clock::now() + kTimeLimit);
  auto done = page.open();
  if (done) done = page.load(address);
  if (!done) return fail(std::move(done.error()));
  return page.evaluate(expression_of(picture));
}

Result<void> write_page(const std::string& path, std::string_view page) {
  auto file = OutputFile::create(path, output_options(false));
  if (!file) return fail(std::move(file.error()));
  file->write(page);
  return file->commit();
}

}  // namespace

Result<std::string> picture_of(std::string_view page, const Picture& picture) {
  const auto program = find_browser();
  if (!program) return fail(program.error());
  const HeldSignals held;
  const auto folder = TemporaryFolder::create();
  if (!folder) return fail(folder.error());
  const std::string path = folder->path() + "/page.html";
  if (auto written = write_page(path, page); !written) return fail(std::move(written.error()));
  const auto text = ask_for_picture(*program, folder->path(), file_address(path), picture);
  if (!text) return text;
  auto bytes = bytes_of_base64(*text);
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
  if (!bytes || !bytes->starts_with(kSignature)) return fail(page_failed("no PNG"));
  return std::move(*bytes);
}

}  // namespace kinefile::cli
