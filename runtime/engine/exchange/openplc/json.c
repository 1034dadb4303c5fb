/* SPDX-License-Identifier: MIT
 *
 * json - a text in JSON as a tree.
 */
#include "engine/exchange/openplc/json.h"

#include "engine/base/lex.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

struct reader {
	struct arena *arena;
	const char *at, *end;
	int line, values;
	bool failed;
};

static void skip(struct reader *r)
{
	while (r->at < r->end && *r->at && strchr(" \t\r\n", *r->at)) {
		r->line += *r->at == '\n';
		r->at++;
	}
}

static bool accept(struct reader *r, char c)
{
	skip(r);
	if (r->at == r->end || *r->at != c)
		return false;
	r->at++;
	return true;
}

/* A code point as UTF-8; a surrogate alone is U+FFFD. */
static size_t put_code(unsigned long code, char *out)
{
	if (code >= 0xd800 && code < 0xe000)
		code = 0xfffd;
	if (code < 0x80) {
		out[0] = code ? (char)code : ' ';
		return 1;
	}
	if (code < 0x800) {
		out[0] = (char)(0xc0 | code >> 6);
		out[1] = (char)(0x80 | (code & 0x3f));
		return 2;
	}
	if (code < 0x10000) {
		out[0] = (char)(0xe0 | code >> 12);
		out[1] = (char)(0x80 | (code >> 6 & 0x3f));
		out[2] = (char)(0x80 | (code & 0x3f));
		return 3;
	}
	out[0] = (char)(0xf0 | code >> 18);
	out[1] = (char)(0x80 | (code >> 12 & 0x3f));
	out[2] = (char)(0x80 | (code >> 6 & 0x3f));
	out[3] = (char)(0x80 | (code & 0x3f));
	return 4;
}

/* Four hexadecimal digits behind \u; false: they are not there. */
static bool read_hex(struct reader *r, unsigned long *code)
{
	*code = 0;
	for (int i = 0; i < 4; i++, r->at++) {
		const char c = r->at < r->end ? *r->at : '\0';
		const int digit = c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 :
				  c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;

		if (digit < 0)
			return false;
		*code = *code * 16 + (unsigned long)digit;
	}
	return true;
}

static bool read_escape(struct reader *r, char *out, size_t *len)
{
	static const char names[] = "\"\\/bfnrt", bytes[] = "\"\\/\b\f\n\r\t";
	const char *name = r->at < r->end && *r->at ? strchr(names, *r->at) : NULL;
	unsigned long code, low;

	if (name) {
		out[(*len)++] = bytes[name - names];
		r->at++;
		return true;
	}
	if (r->at == r->end || *r->at++ != 'u' || !read_hex(r, &code))
		return false;
	if (code >= 0xd800 && code < 0xdc00 && r->end - r->at > 5 && r->at[0] == '\\' && r->at[1] == 'u') {
		r->at += 2;
		if (!read_hex(r, &low))
			return false;
		code = low >= 0xdc00 && low < 0xe000 ? 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00) :
						      0xfffd;
	}
	*len += put_code(code, out + *len);
	return true;
}

/* Behind its first quote. NULL: it has no end, or is damaged. */
static const char *read_string(struct reader *r)
{
	const char *close = r->at;
	size_t len = 0;
	char *text;

	while (close < r->end && *close != '"')
		close += *close == '\\' ? 2 : 1;
	if (close >= r->end)
		return NULL;
	text = arena_alloc(r->arena, (size_t)(close - r->at) + 1);
	while (text && r->at < r->end && *r->at != '"') {
		if ((unsigned char)*r->at < ' ')
			return NULL;
		if (*r->at != '\\') {
			text[len++] = *r->at++;
			continue;
		}
		r->at++;
		if (!read_escape(r, text, &len))
			return NULL;
	}
	if (!text || r->at == r->end || !utf8_valid(text, len, NULL))
		return NULL;
	r->at++;
	return text;
}

static bool read_word(struct reader *r, struct json *json)
{
	static const struct { const char *word; enum json_kind kind; } words[] = {
		{ "null", JSON_NULL }, { "false", JSON_FALSE }, { "true", JSON_TRUE },
	};
	size_t len = 0;

	for (size_t i = 0; i < sizeof(words) / sizeof(*words); i++) {
		len = strlen(words[i].word);
		if ((size_t)(r->end - r->at) >= len && !memcmp(r->at, words[i].word, len)) {
			json->kind = words[i].kind;
			r->at += len;
			return true;
		}
	}
	for (len = 0; r->at + len < r->end && r->at[len] && strchr("+-.0123456789eE", r->at[len]);)
		len++;
	json->kind = JSON_NUMBER;
	json->text = len ? arena_copy(r->arena, r->at, len) : NULL;
	r->at += len;
	return json->text != NULL;
}

/* One that is no list and no object, or the beginning of those. */
static struct json *read_one(struct reader *r, bool in_object)
{
	struct json *json = r->values++ < JSON_VALUES ? arena_alloc(r->arena, sizeof(*json)) : NULL;

	if (!json)
		return NULL;
	json->text = "";
	if (in_object) {
		json->key = accept(r, '"') ? read_string(r) : NULL;
		if (!json->key || !accept(r, ':'))
			return NULL;
	}
	skip(r);
	json->line = r->line;
	if (accept(r, '"')) {
		json->kind = JSON_TEXT;
		json->text = read_string(r);
		return json->text ? json : NULL;
	}
	if (accept(r, '{'))
		json->kind = JSON_OBJECT;
	else if (accept(r, '['))
		json->kind = JSON_LIST;
	else if (!read_word(r, json))
		return NULL;
	return json;
}

static bool is_open(const struct json *json)
{
	return json->kind == JSON_LIST || json->kind == JSON_OBJECT;
}

/* The values of all lists and objects that are open; without recursion. */
static bool read_inside(struct reader *r, struct json *whole)
{
	struct json *open[JSON_DEPTH] = { whole }, **last[JSON_DEPTH] = { &whole->first };
	int depth = 1;

	while (depth) {
		struct json *in = open[depth - 1], *json;
		const bool object = in->kind == JSON_OBJECT;

		if (accept(r, object ? '}' : ']')) {
			depth--;
			continue;
		}
		if (in->first && !accept(r, ','))
			return false;
		json = read_one(r, object);
		if (!json)
			return false;
		*last[depth - 1] = json;
		last[depth - 1] = &json->next;
		if (!is_open(json))
			continue;
		if (depth == JSON_DEPTH)
			return false;
		open[depth] = json;
		last[depth++] = &json->first;
	}
	return true;
}

struct json *json_read(struct arena *arena, const char *text, size_t len, int *line, const char **end)
{
	struct reader r = { .arena = arena, .at = text, .end = text + len, .line = *line };
	struct json *whole = read_one(&r, false);

	if (whole && is_open(whole) && !read_inside(&r, whole))
		whole = NULL;
	*line = r.line;
	*end = r.at;
	return whole;
}

const struct json *json_get(const struct json *json, const char *key)
{
	const struct json *each = json && json->kind == JSON_OBJECT ? json->first : NULL;

	while (each && strcmp(each->key, key) != 0)
		each = each->next;
	return each;
}

const char *json_text(const struct json *json, const char *key)
{
	const struct json *member = json_get(json, key);

	return member && (member->kind == JSON_TEXT || member->kind == JSON_NUMBER) ? member->text : "";
}

int json_int(const struct json *json, const char *key)
{
	const double value = strtod(json_text(json, key), NULL);

	return value > -1e9 && value < 1e9 ? (int)value : 0;
}

const struct json *json_items(const struct json *json)
{
	return json && is_open(json) ? json->first : NULL;
}
