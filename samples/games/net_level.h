/* Levels of the game Net: a text file, one thing a line, its name and then numbers. Metres, kilograms, radians a
   second; x to the right, z up; places are middles. */
#ifndef NET_LEVEL_H
#define NET_LEVEL_H

#include <string>
#include <vector>

enum NetKind {
    NET_BLOCK,  /* x z width height turn: of wood, does not move; turn in degrees */
    NET_BELT,   /* x z width height speed: its upper side runs to the right, or to the left below 0 */
    NET_WHEEL,  /* x z radius spin: a motor turns it, to the left above 0 */
    NET_SEESAW, /* x z length: turns about its middle */
    NET_CRATE,  /* x z size mass */
    NET_ROPE,   /* x z x z: from peg to peg */
    NET_NET,    /* x z width height: from pegs at its upper corners, with holes */
    NET_BANNER, /* x z width height: the same without holes */
    NET_GOAL,   /* x z width height mass: a crate of this mass has to come to rest here */
    NET_PAR,    /* cuts seconds: what a good player needs */
    NET_KIND_COUNT
};

struct NetItem {
    NetKind kind;
    float value[5];
};

struct NetLevel {
    std::string name, hint;
    std::vector<NetItem> items;
};

/* False: it says on stderr what is wrong with which line. */
bool NetLevel_ReadAll(const char* path, std::vector<NetLevel>* levels);

#endif
