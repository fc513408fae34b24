#pragma once
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "description/quantities.hpp"

namespace wormdrive {

// What a page of a report shows, whatever the result is; cli/report/page.js draws it.

/// A column that is drawn; NaN is a gap.
struct ReportSeries {
  std::string name, units, meaning;
  std::vector<double> values;
};

/// A chart: columns over another one, which does not fall.
struct ReportPanel {
  enum class Style { lines, steps, points };  ///< points: the first column is a cloud, the others are lines
  std::vector<double> over;
  std::vector<ReportSeries> series;
  Style style = Style::lines;
  bool filled = false;              ///< between the first two columns
  std::vector<double> limits = {};  ///< lines right across
};

/// A stretch of an axis in which something holds. kind: "stuck", "left", "right", of which the colours are.
struct ReportBand {
  double from, to;
  std::string kind, meaning;
};

/// What happens at a place on an axis.
struct ReportEvent {
  struct Change {
    std::string name, units;
    double before, after;
  };
  double at;
  std::string what, before, after;
  std::vector<Change> changes;
};

/// Charts whose axes move together.
struct ReportGroup {
  std::string title, over, units;  ///< of the axis
  std::vector<ReportPanel> panels;
  std::vector<ReportBand> bands = {};
  std::vector<ReportEvent> events = {};
  std::size_t all_events = 0;  ///< that happen, of which those are shown
};

struct ReportTable {
  struct Head {
    std::string name;
    bool number = false;
  };
  std::string title;
  std::vector<Head> heads;
  std::vector<std::vector<std::variant<std::string, double>>> rows;
  std::string note = {};
};

/// A text that is shown when it is asked for.
struct ReportText {
  std::string title, text;
};

struct ReportPage {
  std::string title;
  std::string summary;               ///< a sentence on what it is
  std::string verdict = {};          ///< a sentence on what it comes to
  std::vector<std::string> remarks;  ///< warnings
  std::vector<ReportGroup> groups;
  std::vector<ReportTable> tables;
  std::vector<ReportText> texts = {};
};

/// A name as people write it: "break_away" as "break away".
std::string words(std::string name);

/// Quantities as a table.
ReportTable table_of(const std::string& title, const std::vector<Quantity>& quantities);

/// What a page has beside its result, as HTML: before its charts, and after its own script.
struct PageAdditions {
  std::string before = {}, after = {};
};

/// One page of HTML that needs nothing else. Of long columns it shows the rows where one of them is largest or
/// smallest.
std::string to_html(const ReportPage& page, const PageAdditions& additions = {});

/// What the script of a page draws.
std::string to_json(const ReportPage& page);

/// JSON as it may stand inside <script>.
std::string embedded(const nlohmann::ordered_json& data);

}  // namespace wormdrive
