// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "options.h"

#include <set>

#include "reconstruct.h"
#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;

TEST_CASE("options are set from text, and errors name the option, the value and what is meant") {
  bool flag = false;
  int count = 3;
  double size = 0.5;
  const OptionList options = {{"a.flag", &flag, "", "a switch"},
                              {"a.count", &count, "", "a count", 1, 10},
                              {"a.size", &size, "m", "a length", 0, 2}};
  set_option(options, "a.flag", "true");
  set_option(options, "a.count", "10");
  set_option(options, "a.size", "1e-1");
  CHECK(flag);
  CHECK(count == 10);
  CHECK(size == 0.1);
  const auto error = [&](const char* name, const char* value) {
    return error_of(Cause::usage, [&] { set_option(options, name, value); });
  };
  CHECK(contains(error("a.sise", "1"), "the nearest is 'a.size'"));
  CHECK(contains(error("a.count", "11"), "11 is not from 1 to 10"));
  CHECK(contains(error("a.count", "2.5"), "'2.5' is not a whole number"));
  CHECK(contains(error("a.size", "nan"), "a.size"));
  CHECK(contains(error("a.size", "wide"), "'wide' is not a number"));
  CHECK(contains(error("a.flag", "1"), "true or false"));
  CHECK(count == 10);
}

TEST_CASE(
    "every option of the reconstruction has a name of its own, a meaning, and a default within its "
    "range") {
  ReconstructOptions defaults;
  std::set<std::string> names;
  for (const Option& option : list_options(defaults)) {
    CHECK(names.insert(option.name).second);
    CHECK_FALSE(option.meaning.empty());
    set_option(list_options(defaults), option.name, text_of(option.value()));
  }
}

TEST_CASE("presets differ from each other and each is valid") {
  std::set<std::string> seen;
  for (const std::string& preset : preset_names()) {
    ReconstructOptions options;
    apply_preset(options, preset);
    std::string text;
    for (const Option& option : list_options(options)) {
      text += option.name + "=" + text_of(option.value()) + "\n";
      set_option(list_options(options), option.name, text_of(option.value()));
    }
    CHECK(seen.insert(text).second);
  }
  ReconstructOptions options;
  CHECK(contains(error_of(Cause::usage, [&] { apply_preset(options, "underwater"); }),
                 "'underwater'"));
}
