/* SPDX-License-Identifier: MIT
 *
 * bank - a simulated GPIO chip of the kernel's gpio-sim: made, pulled, read,
 * watched and unplugged from outside, as a person with a wire would.
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
	int value[BANK_LINES]; /* open files; -1                              */
	int watch;             /* chip, told of who takes a line; -1          */
};

/** bank_can - is gpio-sim here? */
bool bank_can(void);
/** bank_up - a chip with @count lines; names may be NULL, all or some.
 * @hog: line that somebody called "other" holds at 1; -1: none. */
void bank_up(struct bank *bank, const char *word, const char *const *name,
	     unsigned count, int hog);
void bank_unplug(struct bank *bank);
/** bank_plug - back again; all pulls are down, its number may be another. */
void bank_plug(struct bank *bank);
void bank_down(struct bank *bank);

void bank_pull(struct bank *bank, unsigned line, bool up);
/** bank_level - what the line shows now. */
bool bank_level(struct bank *bank, unsigned line);
/** bank_levels - of lines @first to @first + @count - 1, a bit each. */
uint32_t bank_levels(struct bank *bank, unsigned first, unsigned count);
/** bank_shows - waits until they do; false: not within @ms. */
bool bank_shows(struct bank *bank, unsigned first, unsigned count,
		uint32_t want, int64_t ms);

/** bank_watch - from now on bank_events() counts lines that were taken or given
 * back, by whomever. */
void bank_watch(struct bank *bank);
/** bank_was_taken - was this line taken since it was asked last? */
bool bank_was_taken(struct bank *bank, unsigned line);
/** bank_events - how many since it was asked last. */
unsigned bank_events(struct bank *bank);
#endif
