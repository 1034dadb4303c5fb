/* SPDX-License-Identifier: MIT
 *
 * json - a text in JSON as a tree, with the line of each value.
 *
 * The lines are why this is no library: a message about a project names the place in its file.
 * It reads the JSON of RFC 8259 and nothing more.
 */
#ifndef OPENPLC_JSON_H
#define OPENPLC_JSON_H

#include "engine/base/arena.h"

enum json_kind { JSON_NULL, JSON_FALSE, JSON_TRUE, JSON_NUMBER, JSON_TEXT, JSON_LIST, JSON_OBJECT };

enum { JSON_DEPTH = 48, JSON_VALUES = 4000000 };

struct json {
	enum json_kind kind;
	int line;
	const char *key;         /* in an object; NULL: in a list                  */
	const char *text;        /* of a number or text, UTF-8; "" else            */
	struct json *first, *next;
};

/**
 * json_read - the value at the beginning of a text
 * @line: of the first byte; gets the line of what is wrong
 * @end:  gets what is behind the value
 *
 * Owns: @arena.   Fails: NULL: it is no JSON, too deep, or no memory.
 */
struct json *json_read(struct arena *arena, const char *text, size_t len, int *line, const char **end);
/** json_get - the member of an object; NULL: it has none, or @json is no object or NULL. */
const struct json *json_get(const struct json *json, const char *key);
/** json_text - the text of a member; "" without one. */
const char *json_text(const struct json *json, const char *key);
/** json_int - a whole number of a member, within an int; 0 without one. */
int json_int(const struct json *json, const char *key);
/** json_items - the first value of a list or object; NULL: there is none. */
const struct json *json_items(const struct json *json);
#endif
