/* SPDX-License-Identifier: MIT
 *
 * conf - settings of a board that a desk has changed: the file `conf` in the folder of slots.
 *
 * The command line has the defaults. The file is text with a checksum; it is replaced as a
 * whole, and a damaged one is not used. Used by the link thread, after the start.
 */
#ifndef LADDERD_CONF_H
#define LADDERD_CONF_H

#include "ladderd/options.h"
#include "online/server.h"

#define CONF_SETTINGS 7

struct conf {
	const char *folder;      /* NULL: no --slots, so nothing can be stored */
	struct options defaults; /* of the command line                        */
	struct options now, next; /* in force; after the next start            */
	char text[CONF_SETTINGS][SETTING_TEXT]; /* as stored; "": the default  */
	bool damaged;            /* the file could not be used                 */
};

/** conf_load - changes @options as the file says. Scan-safe: no; so are all functions.
 * Fails: never; sets `damaged`, after a message. */
void conf_load(struct conf *conf, struct options *options);
/** conf_get - a setting; false: there is none with this number. */
bool conf_get(const struct conf *conf, uint32_t number, struct setting *out);
/**
 * conf_change - stores a setting
 * @value: "": that of the command line again
 * @changed: gets the setting as it was
 * @detail: parts of a diagnostic
 */
enum refusal conf_change(struct conf *conf, const char *key, const char *value,
			 struct setting *changed, char *detail, size_t size);
/** conf_in_force - what needs no restart is in force now. */
void conf_in_force(struct conf *conf);
#endif
