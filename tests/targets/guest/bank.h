/* SPDX-License-Identifier: MIT
 *
 * bank - a simulated GPIO chip of the kernel (gpio-sim): creates it, sets and reads its
 * lines, watches and unplugs it from outside, like a person with a wire.
 */
#ifndef GUEST_BANK_H
#define GUEST_BANK_H

#include <stdbool.h>
#include <stdint.h>

#define BANK_LINES 40
#define BANK_NAME  48

struct bank {
	char word[BANK_NAME];  /* its folder, and the label of the chip       */
	char chip[BANK_NAME];  /* "gpiochip0", while it is plugged in         */
	char lines[128];       /* sysfs folder of its lines                   */
	unsigned count;
	int value[BANK_LINES]; /* open files; -1: closed                      */
	int watch;             /* chip, reports requested lines; -1: closed   */
};

/** bank_can - whether the kernel has gpio-sim. */
bool bank_can(void);
/** bank_up - creates a chip with @count lines; all or some names may be NULL. @hog: line
 * that "other" holds at 1; -1: none. A chip of this name that is still there ends the suite. */
void bank_up(struct bank *bank, const char *word, const char *const *name,
	     unsigned count, int hog);
void bank_unplug(struct bank *bank);
/** bank_plug - creates the chip again; all pulls are down, and its number may differ. */
void bank_plug(struct bank *bank);
void bank_down(struct bank *bank);

void bank_pull(struct bank *bank, unsigned line, bool up);
/** bank_level - the present level of a line. */
bool bank_level(struct bank *bank, unsigned line);
/** bank_levels - the levels of lines @first to @first + @count - 1, one bit each. */
uint32_t bank_levels(struct bank *bank, unsigned first, unsigned count);
/** bank_shows - waits until the lines have these levels. False: not within @ms. */
bool bank_shows(struct bank *bank, unsigned first, unsigned count,
		uint32_t want, int64_t ms);

/** bank_watch - starts counting lines that are requested or released by any program. */
void bank_watch(struct bank *bank);
/** bank_was_taken - whether a line was requested since the last call. */
bool bank_was_taken(struct bank *bank, unsigned line);
/** bank_events - number of events since the last call. */
unsigned bank_events(struct bank *bank);
#endif
