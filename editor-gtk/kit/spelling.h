/* SPDX-License-Identifier: MIT
 *
 * spelling - addresses as a person reads and types them: %QX0.0 or Q0.0.
 *
 * The one place that knows both. Files, exports and messages of the engine have the first; what
 * the window draws, lists and offers goes through here. It knows no project: the owner of a rule
 * says which texts are names.
 */
#ifndef EDITOR_SPELLING_H
#define EDITOR_SPELLING_H

#include "engine/base/iec.h"

#include <stdbool.h>
#include <stddef.h>

enum spelling { SPELLING_IEC, SPELLING_SIEMENS };

struct spelling_rule {
	enum spelling spelling;
	/** Has the program a variable of this name? NULL: unknown; then no text without a % is
	 * taken for an address. */
	bool (*is_name)(void *context, const char *text, size_t len);
	void *context;
};

/** spelling_screen - the one that the preferences ask for. */
enum spelling spelling_screen(void);
/**
 * spelling_address - an address in one spelling; returns as snprintf
 *
 * As %…, whatever @spelling: what has no other form (%ML0), and what means something else in other
 * controllers without the % (SM0.6).
 */
int spelling_address(enum spelling spelling, struct iec_addr addr, char *out, size_t size);
/** spelling_text - @text with all its addresses in one spelling; comments and texts in quotes stay. A
 * name that looks like an address (Q0) stays, and the address that would look like it too. Owns: the
 * caller, g_free(). */
char *spelling_text(const struct spelling_rule *rule, const char *text);
/** spelling_shown - the same as the preferences ask for, for texts whose addresses all have a %. */
char *spelling_shown(const char *text);

#endif
