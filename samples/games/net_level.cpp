#include "net_level.h"

#include <cstdio>
#include <fstream>
#include <sstream>

namespace
{

struct Word {
    const char* name;
    int count; /* of numbers */
};

/* In the order of NetKind. */
const Word WORDS[NET_KIND_COUNT] = {
    { "block", 5 }, { "belt", 5 }, { "wheel", 4 },  { "seesaw", 3 }, { "crate", 4 },
    { "rope", 4 },  { "net", 4 },  { "banner", 4 }, { "goal", 5 },   { "par", 2 },
};

bool ReadItem(const std::string& word, std::istream& rest, NetItem* item)
{
    for (int kind = 0; kind < NET_KIND_COUNT; ++kind) {
        if (word != WORDS[kind].name) {
            continue;
        }
        item->kind = static_cast<NetKind>(kind);
        for (int i = 0; i < WORDS[kind].count; ++i) {
            if (!(rest >> item->value[i])) {
                return false;
            }
        }
        std::string more;
        return !(rest >> more);
    }
    return false;
}

bool ReadLine(const std::string& line, std::vector<NetLevel>* levels)
{
    std::istringstream words(line);
    std::string word;
    if (!(words >> word) || word[0] == '#') {
        return true;
    }
    if (word == "level") {
        levels->push_back(NetLevel());
        return static_cast<bool>(std::getline(words >> std::ws, levels->back().name));
    }
    if (levels->empty()) {
        return false;
    }
    if (word == "hint") {
        return static_cast<bool>(std::getline(words >> std::ws, levels->back().hint));
    }
    NetItem item = NetItem();
    bool good = ReadItem(word, words, &item);
    levels->back().items.push_back(item);
    return good;
}

} // namespace

bool NetLevel_ReadAll(const char* path, std::vector<NetLevel>* levels)
{
    std::ifstream file(path);
    if (!file) {
        std::fprintf(stderr, "cannot read %s\n", path);
        return false;
    }
    std::string line;
    for (int number = 1; std::getline(file, line); ++number) {
        if (!ReadLine(line, levels)) {
            std::fprintf(stderr, "%s:%d: what is '%s'?\n", path, number, line.c_str());
            return false;
        }
    }
    return !levels->empty();
}
