// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "viewer/base64.h"

#include "support/support.h"

using namespace scanworld;

TEST_CASE("base64 agrees with the vectors of RFC 4648") {
  const std::pair<std::string, std::string> vectors[] = {{"", ""},
                                                         {"f", "Zg=="},
                                                         {"fo", "Zm8="},
                                                         {"foo", "Zm9v"},
                                                         {"foob", "Zm9vYg=="},
                                                         {"fooba", "Zm9vYmE="},
                                                         {"foobar", "Zm9vYmFy"},
                                                         {"\xff\xef\xbe", "/+++"}};
  for (const auto& [bytes, text] : vectors) CHECK(base64(bytes.data(), bytes.size()) == text);
}

TEST_CASE("numbers are written with their lowest byte first") {
  CHECK(base64(std::vector<std::uint16_t>{0x0102}) == "AgE=");
  CHECK(base64(std::vector<std::int32_t>{-1}) == "/////w==");
}
