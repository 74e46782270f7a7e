#include "games.h"
#include "shell.h"

#include <stddef.h>

int main(int count, char** words)
{
    const GameType* const games[] = { &curtainGame, &netGame, NULL };
    return Shell_Run(count, words, games);
}
