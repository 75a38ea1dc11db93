#include "page_text.hpp"

#include <kte/errors.hpp>

#include "page_limits.hpp"
#include "page_resource.hpp"
#include "scene_checks.hpp"

namespace kte::view {

namespace {
constexpr std::string_view begin_of_place = R"(<script type="application/json" id="kte-scene">)";
constexpr std::string_view empty_place = R"(<script type="application/json" id="kte-scene">null</script>)";
constexpr std::string_view live_element = R"(<script type="application/json" id="kte-live">{}</script>
)";
}  // namespace

std::string page_text(const scene& s, const page_options& options, std::string_view other_title, bool live) {
  check(s);
  scene drawn = within_limits(s, options);
  if (!options.title.empty()) drawn.title = options.title;
  if (drawn.title.empty()) drawn.title = other_title;
  if (live)  // its columns are also those that are only recorded
    for (auto& r : drawn.recordings) r.plotted.clear();
  const auto page = page_resource();
  const auto place = page.find(empty_place);
  if (place == page.npos) detail::raise<bad_file>("kte: the page in the library kte::view lacks the place of a scene");
  std::string text(page.substr(0, place));
  if (live) text += live_element;
  text += begin_of_place;
  text += to_json(drawn);
  text += page.substr(place + begin_of_place.size() + std::string_view("null").size());
  return text;
}

}  // namespace kte::view
