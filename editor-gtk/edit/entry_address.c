/* SPDX-License-Identifier: MIT
 *
 * entry_address - which part of a wrong address is wrong; see entry_address.h.
 */
#include "editor-gtk/edit/entry_address.h"

#include "editor-gtk/edit/entry_names.h"
#include "editor-gtk/kit/i18n.h"
#include "engine/base/ascii.h"
#include "engine/base/iec.h"

#include <stdio.h>
#include <string.h>

/* Where the parts of an address begin, %[AI][W][4][.3]; a part that is missing begins where the next
 * one does. */
struct pieces {
	size_t area, size, number, bit, end;
	enum iec_area is;
};

static size_t digits(const char *text, size_t at)
{
	while (text[at] >= '0' && text[at] <= '9')
		at++;
	return at;
}

/* The longest name of an area that begins here. */
static size_t area_at(const char *text, enum iec_area *area)
{
	size_t most = 0;

	for (int i = AREA_NONE + 1; i < AREA_COUNT; i++) {
		const char *letters = iec_area_row((enum iec_area)i)->letters;
		const size_t len = strlen(letters);

		if (len > most && strlen(text) >= len && ascii_is(letters, text, len)) {
			most = len;
			*area = (enum iec_area)i;
		}
	}
	return most;
}

static struct pieces take_apart(const char *text)
{
	struct pieces at = { .area = *text == '%' };

	at.size = at.area + area_at(text + at.area, &at.is);
	at.number = at.size + (at.size > at.area && text[at.size] && strchr("XBWDLxbwdl", text[at.size]));
	at.bit = digits(text, at.number);
	at.end = text[at.bit] == '.' ? digits(text, at.bit + 1) : at.bit;
	return at;
}

/* @why: N_() text with a %s for the address; it may have one more for @instead. */
static void blame(struct entry *entry, const char *why, const char *instead, size_t from, size_t to)
{
	entry->why = why;
	snprintf(entry->instead, sizeof(entry->instead), "%s", instead);
	entry->wrong_at = from;
	entry->wrong_len = to - from;
}

static void blame_area(struct entry *entry, const struct pieces *at)
{
	char areas[sizeof(entry->instead)] = "";
	size_t end = at->area, used = 0;

	for (int i = AREA_NONE + 1; i < AREA_COUNT && used < sizeof(areas); i++)
		used += (size_t)snprintf(areas + used, sizeof(areas) - used, "%s%s", used ? ", " : "",
					 iec_area_row((enum iec_area)i)->letters);
	end += strcspn(entry->what + end, "0123456789.");
	blame(entry, N_("“%s” is not an address: the areas are %s"), areas, at->area, end);
}

static unsigned last_bit(char size)
{
	switch (size & ~0x20) {
	case 'W': return 15;
	case 'D': return 31;
	case 'L': return 63;
	default: return 7;
	}
}

/* It can be read, but there is no such bit or byte. */
static void blame_range(const struct entry_place *place, struct entry *entry, const struct pieces *at)
{
	const unsigned bits = last_bit(entry->what[at->size]);
	struct areas areas;
	struct iec_addr addr;
	char last[24];

	if (iec_addr_fault(entry->what, strlen(entry->what), &addr) == DIAG_BAD_BIT) {
		snprintf(last, sizeof(last), "%u", bits);
		blame(entry, bits == 7 ? N_("“%s” is not an address: the bits of a byte are 0 to 7") :
		      N_("“%s” is not an address: its bits are 0 to %s"), last, at->bit + 1, at->end);
		return;
	}
	project_areas(place->project, &areas);
	snprintf(last, sizeof(last), "%u", (unsigned)areas.bytes[at->is] - 1);
	blame(entry, N_("“%s” is not an address of this project: its area ends at byte %s"), last, at->number, at->bit);
}

/* It cannot be read. */
static void blame_form(struct entry *entry, const struct pieces *at, size_t len)
{
	if (at->size == at->area)
		blame_area(entry, at);
	else if (at->bit == at->number)
		blame(entry, N_("“%s” is not an address: behind the area stand X, B, W, D or L, and a number"), "",
		      at->number < len ? at->number : 0, len);
	else if (at->end < len) {
		entry->wrong_at = at->end;
		entry->wrong_len = len - at->end;
	}
}

void entry_blame_address(const struct entry_place *place, struct entry *entry)
{
	const size_t len = strlen(entry->what);
	const struct pieces at = take_apart(entry->what);
	enum iec_addr_result result;
	struct iec_addr addr;

	if (entry->sense != ENTRY_WRONG || entry->known || !len || entry_var_find(place, entry->what, len, NULL))
		return;
	result = iec_addr_parse(entry->what, len, &addr);
	if (result == ADDR_RANGE || (result == ADDR_OK && !project_has(place->project, addr)))
		blame_range(place, entry, &at);
	else if (entry->why == entry_no_address)
		blame_form(entry, &at, len);
}
