// SPDX-License-Identifier: Apache-2.0
// pointrt-info: tells what is in a .pro file, checks it, exports it.
#include <CLI/CLI.hpp>
#include <filesystem>

#include "format/base/printable.h"
#include "format/base/run_tool.h"
#include "format/info/export_ply.h"
#include "format/info/metadata.h"
#include "format/info/print.h"

namespace {

using namespace pointrt;
using Json = nlohmann::ordered_json;

struct Options {
    std::string input, export_path;
    bool json = false, verify = false, force = false;
};

void addOptions(CLI::App& app, Options& options) {
    app.add_option("FILE", options.input, "the .pro file")->required();
    auto* json = app.add_flag("--json", options.json, "print JSON instead of text");
    auto* verify = app.add_flag("--verify", options.verify, "make every check there is; exit 1 on findings");
    auto* out = app.add_option("--export", options.export_path, "write the splats in input order as PLY");
    app.add_flag("-f,--force", options.force, "let --export overwrite a file")->needs(out);
    out->excludes(json)->excludes(verify);
    app.set_version_flag("--version", POINTRT_VERSION);
    app.footer("Exit codes: 0 done, 1 FILE is wrong, 2 wrong usage, 3 this machine can't, 4 cannot write.");
}

struct FindingList {
    std::vector<pro_message> findings;

    static void add(const pro_message* finding, void* user) {
        static_cast<FindingList*>(user)->findings.push_back(*finding);
    }
};

void printFindings(const Options& options, const FindingList& list) {
    if (options.json) {
        Json json = {{"file", options.input}, {"findings", Json::array()}};
        for (const pro_message& finding : list.findings)
            json["findings"].push_back({{"number", finding.finding}, {"text", finding.text}});
        std::printf("%s\n", dumpJson(json, false).c_str());
        return;
    }
    const std::string shown = printable(options.input, std::string::npos);
    for (const pro_message& finding : list.findings)
        std::printf("%s: finding %04u: %s\n", shown.c_str(), finding.finding,
                    printable(finding.text, std::string::npos).c_str());
    if (list.findings.empty()) std::printf("%s: no findings\n", shown.c_str());
}

int verify(const Options& options) {
    FindingList list;
    std::size_t count = 0;
    pro_message message{};
    checkPro(pro_verify(options.input.c_str(), FindingList::add, &list, &count, &message), options.input, message);
    printFindings(options, list);
    if (count == 0) return 0;
    throw Error(ExitCode::kBadInput,
                options.input + ": " + std::to_string(count) + (count == 1 ? " finding" : " findings"));
}

int exportSplats(const Options& options) {
    const ProFile file(options.input);
    std::error_code ignored;
    if (std::filesystem::equivalent(options.input, options.export_path, ignored))
        throw Error(ExitCode::kBadUsage, options.export_path + ": is the input");
    exportPly(file, options.export_path, options.force);
    return 0;
}

int print(const Options& options) {
    const ProFile file(options.input);
    const Summary summary = summarize(file);
    const std::string text = options.json ? summaryJson(summary, file) : summaryText(options.input, summary, file);
    std::fwrite(text.data(), 1, text.size(), stdout);
    return 0;
}

int runOptions(const Options& options) {
    const int code = options.verify                ? verify(options)
                     : options.export_path.empty() ? print(options)
                                                   : exportSplats(options);
    if (std::fflush(stdout) != 0) throw Error(ExitCode::kCannotWrite, "standard output: cannot write");
    return code;
}

} // namespace

int main(int argc, char** argv) {
    return runTool("pointrt-info", [&] {
        CLI::App app("Tells what is in a .pro file.", "pointrt-info");
        Options options;
        addOptions(app, options);
        try {
            app.parse(argc, argv);
        } catch (const CLI::Success& success) {
            return app.exit(success);
        } catch (const CLI::ParseError& error) {
            throw Error(ExitCode::kBadUsage, std::string(error.what()) + "; --help tells more");
        }
        return runOptions(options);
    });
}
