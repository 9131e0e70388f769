// SPDX-License-Identifier: GPL-3.0-or-later
// Prints the version that the linked libmeshlab-common was built as. Run by the build, which trusts no number that
// somebody typed.
#include <cstdio>

#include <QString>

// What is needed of MeshLab's class: without its header the program compiles at once.
class MeshLabApplication {
public:
    static const QString appVer();
};

int main() {
    std::puts(qPrintable(MeshLabApplication::appVer()));
    return 0;
}
