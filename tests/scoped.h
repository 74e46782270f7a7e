/* Variables that end with their scope. */
#ifndef KIRI_TEST_SCOPED_H
#define KIRI_TEST_SCOPED_H

/* Declares a variable of zeros, for which `end` is called at the end of its scope. */
#define SCOPED(Type, name, end) __attribute__((cleanup(end))) Type name = { 0 }

#endif
