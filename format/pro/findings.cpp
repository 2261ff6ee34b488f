// SPDX-License-Identifier: Apache-2.0
#include "format/pro/findings.h"

#include <cinttypes>
#include <cstdarg>
#include <cstdio>

namespace pointrt::format {

Findings::Findings(pro_report report, void* user, bool stop_at_first)
    : report_(report), user_(user), stop_at_first_(stop_at_first) {}

void Findings::add(Finding finding, const char* format, ...) {
    if (stopped()) return;
    ++count_;
    if (!report_) return;
    pro_message message;
    message.finding = static_cast<std::uint32_t>(finding);
    std::va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(message.text, sizeof message.text, format, arguments);
    va_end(arguments);
    report_(&message, user_);
}

void Tally::addTo(Findings& findings, Finding finding, const char* what, const char* reason) const {
    if (places == 1) {
        findings.add(finding, "%s %" PRIu64 ": %s", what, first, reason);
    } else if (places > 1) {
        findings.add(finding, "%s %" PRIu64 ": %s (and %" PRIu64 " more)", what, first, reason, places - 1);
    }
}

void setMessage(pro_message* message, std::uint32_t finding, const char* format, ...) {
    if (!message) return;
    message->finding = finding;
    std::va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(message->text, sizeof message->text, format, arguments);
    va_end(arguments);
}

} // namespace pointrt::format
