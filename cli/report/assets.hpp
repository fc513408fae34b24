#pragma once
#include <string_view>

/// Files that the build puts into the program (cli/report, cli/view, and dygraphs from the system).
namespace wormdrive::assets {

extern const std::string_view page_html, page_css, page_js, view_css, view_js, dygraphs_js, dygraphs_css,
    dygraphs_notice;

}  // namespace wormdrive::assets
