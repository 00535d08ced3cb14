# SPDX-FileCopyrightText: 2026 The scanworld authors
# SPDX-License-Identifier: Apache-2.0
#
# cmake -DINPUT=F -DOUTPUT=F.cpp -DNAME=name -P embed.cmake: writes a function std::string scanworld::NAME() that
# gives a text file. In parts, since compilers limit how long one literal may be.
file(READ "${INPUT}" text)
string(LENGTH "${text}" length)
set(source "// Made from ${NAME} by cmake/embed.cmake.\n#include <string>\n\nnamespace scanworld {\n\nstd::string ${NAME}();\n\nstd::string ${NAME}() {\n  std::string text;\n")
set(at 0)
while(at LESS length)
  string(SUBSTRING "${text}" ${at} 60000 part)
  string(APPEND source "  text += R\"~EMBED~(${part})~EMBED~\";\n")
  math(EXPR at "${at} + 60000")
endwhile()
string(APPEND source "  return text;\n}\n\n}  // namespace scanworld\n")
file(WRITE "${OUTPUT}" "${source}")
