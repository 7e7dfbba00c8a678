// What is here: prints the reference of docs/design-files.md from the table of keys. What is not: the text around it.
#include <iostream>

#include "tests/support/reference_text.h"

int main() {
  std::cout << perfora::test::reference_text();
}
