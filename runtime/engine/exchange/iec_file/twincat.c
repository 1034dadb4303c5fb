/* SPDX-License-Identifier: MIT
 *
 * twincat - the text in an object of TwinCAT 3 (.TcPOU, .TcDUT, .TcGVL), which is XML.
 *
 * Its declaration and its body keep their places; all markup becomes blanks. It knows as much of
 * XML as such files have: no DOCTYPE, no entities but the five of XML itself.
 */
#include "engine/exchange/iec_file/iec_file_parts.h"

#include "engine/base/ascii.h"
#include "engine/base/lex.h"

#include <stdlib.h>
#include <string.h>

#define DEPTH_MOST 32 /* elements inside one another                         */
#define NAME_MOST 40

/* What an element means. */
enum element { ELEMENT_OTHER, ELEMENT_POU, ELEMENT_TEXT, ELEMENT_IMPLEMENTATION, ELEMENT_ACTION,
	       ELEMENT_SKIP };

struct twincat {
	const char *at, *end, *begin;
	char *out;
	size_t len;
	enum element open[DEPTH_MOST];
	int depth;
	int skip;               /* depth of an element that is left out; 0: none */
	const char *close;      /* END_… of the POU; NULL: none                */
	struct diag place;
	struct diag_list *diags;
	bool broken;
};

bool twincat_is(const char *bytes, size_t len)
{
	static const char name[] = "<TcPlcObject";
	const size_t most = len < 1024 ? len : 1024;

	for (size_t i = 0; i + strlen(name) <= most; i++) {
		if (!memcmp(bytes + i, name, strlen(name)))
			return true;
		if (!bytes[i])
			return false;
	}
	return false;
}

static void tell(struct twincat *t, enum diag_id id, const char *at, const char *text, size_t len)
{
	const char *line = at;

	t->place.id = id;
	t->place.line = 1;
	for (const char *byte = t->begin; byte < at; byte++)
		t->place.line += *byte == '\n';
	while (line > t->begin && line[-1] != '\n')
		line--;
	t->place.column = (int)(at - line) + 1;
	diag_add(t->diags, t->place, "%.*s", (int)(len < NAME_MOST ? len : NAME_MOST), text);
}

static void damaged(struct twincat *t, const char *expected)
{
	if (!t->broken)
		tell(t, DIAG_XML_BROKEN, t->at, expected, strlen(expected));
	t->broken = true;
}

/* Blanks in place of [t->at, to). */
static void pass(struct twincat *t, const char *to)
{
	for (; t->at < to; t->at++)
		t->out[t->len++] = *t->at == '\n' || *t->at == '\r' ? *t->at : ' ';
}

static void copy(struct twincat *t, const char *to)
{
	memcpy(t->out + t->len, t->at, (size_t)(to - t->at));
	t->len += (size_t)(to - t->at);
	t->at = to;
}

/* The first @word from @from on; NULL: there is none. */
static const char *find(const char *from, const char *end, const char *word)
{
	const size_t len = strlen(word);

	for (; (size_t)(end - from) >= len; from++) {
		from = memchr(from, *word, (size_t)(end - from) - len + 1);
		if (!from)
			return NULL;
		if (!memcmp(from, word, len))
			return from;
	}
	return NULL;
}

static bool begins(const struct twincat *t, const char *word)
{
	return (size_t)(t->end - t->at) >= strlen(word) && !memcmp(t->at, word, strlen(word));
}

static bool in_text(const struct twincat *t)
{
	return !t->skip && t->depth && t->open[t->depth - 1] == ELEMENT_TEXT;
}

/* ---- text ---- */

/* Which END_… the POU needs, by the first word of its declaration. */
static void note_close(struct twincat *t, const char *text, size_t len)
{
	static const char *const words[][2] = {
		{ "PROGRAM", "END_PROGRAM" }, { "FUNCTION", "END_FUNCTION" },
		{ "FUNCTION_BLOCK", "END_FUNCTION_BLOCK" },
	};
	struct lex lex;

	if (t->close || t->depth < 2 || t->open[t->depth - 2] != ELEMENT_POU)
		return;
	lex_init(&lex, text, len);
	while (lex_next(&lex) == TOKEN_SYMBOL && lex_is(&lex, "{"))
		lex.at = find(lex.at, lex.end, "}") ? find(lex.at, lex.end, "}") + 1 : lex.end;
	for (size_t i = 0; i < sizeof(words) / sizeof(*words); i++)
		if (lex_is(&lex, words[i][0]))
			t->close = words[i][1];
}

static void read_cdata(struct twincat *t)
{
	const char *from = t->at + strlen("<![CDATA["), *to = find(from, t->end, "]]>");

	if (!to) {
		damaged(t, "]]>");
		return;
	}
	pass(t, from);
	if (in_text(t)) {
		note_close(t, from, (size_t)(to - from));
		copy(t, to);
	}
	pass(t, to + 3);
}

/* One of the five entities of XML. */
static void read_entity(struct twincat *t)
{
	static const char *const names[] = { "&lt;<", "&gt;>", "&amp;&", "&quot;\"", "&apos;'" };

	for (size_t i = 0; i < sizeof(names) / sizeof(*names); i++) {
		const size_t len = strlen(names[i]) - 1;

		if ((size_t)(t->end - t->at) < len || memcmp(t->at, names[i], len) != 0)
			continue;
		t->at += len;
		t->out[t->len++] = names[i][len];
		return;
	}
	damaged(t, "&lt; &gt; &amp; &quot; &apos;");
}

static void read_characters(struct twincat *t)
{
	const char *from = t->at;
	const bool text = in_text(t);

	while (t->at < t->end && *t->at != '<' && !t->broken) {
		if (!text)
			pass(t, t->at + 1);
		else if (*t->at == '&')
			read_entity(t);
		else
			copy(t, t->at + 1);
	}
	if (text && t->at > from)
		note_close(t, from, (size_t)(t->at - from));
}

/* ---- markup ---- */

static bool is(const char *word, const char *name, size_t len)
{
	return strlen(word) == len && !memcmp(word, name, len);
}

/* The parts of a POU that the languages here have no form for. */
static bool is_object_part(const char *name, size_t len)
{
	return is("Method", name, len) || is("Property", name, len) ||
	       is("Transition", name, len) || is("Itf", name, len);
}

/* @to: behind the tag. */
static enum element element_of(struct twincat *t, const char *name, size_t len, const char *to)
{
	const enum element outer = t->depth ? t->open[t->depth - 1] : ELEMENT_OTHER;
	const char *value = find(name, to, "Name=\""), *quote;

	if (t->skip)
		return ELEMENT_SKIP;
	if (is_object_part(name, len)) {
		value = value ? value + strlen("Name=\"") : name;
		quote = value == name ? NULL : memchr(value, '"', (size_t)(to - value));
		tell(t, DIAG_OBJECT_PART, name, quote ? value : name,
		     quote ? (size_t)(quote - value) : len);
		return ELEMENT_SKIP;
	}
	if (is("POU", name, len))
		return ELEMENT_POU;
	if (is("Action", name, len) && value && outer == ELEMENT_POU)
		return ELEMENT_ACTION;
	if (is("Declaration", name, len))
		return ELEMENT_TEXT;
	if (is("Implementation", name, len))
		return ELEMENT_IMPLEMENTATION;
	if (outer != ELEMENT_IMPLEMENTATION)
		return ELEMENT_OTHER;
	if (is("ST", name, len) || is("IL", name, len))
		return ELEMENT_TEXT;
	tell(t, DIAG_OTHER_BODY, name, name, len);
	return ELEMENT_SKIP;
}

/* Behind the > of the tag at t->at, which may stand in quotes; NULL: there is none. */
static const char *end_of_tag(const struct twincat *t)
{
	char quote = 0;

	for (const char *at = t->at; at < t->end; at++) {
		if (quote && *at == quote)
			quote = 0;
		else if (!quote && (*at == '"' || *at == '\''))
			quote = *at;
		else if (!quote && *at == '>')
			return at + 1;
	}
	return NULL;
}

/* On a line of its own: the body may end with a // comment. A line that is there is used, so that all
 * others keep their numbers. */
static void put_end(struct twincat *t, const char *word)
{
	size_t at = t->len;

	while (at > 0 && t->out[at - 1] == ' ')
		at--;
	if (at == 0 || t->out[at - 1] != '\n')
		t->out[t->len++] = '\n';
	memcpy(t->out + t->len, word, strlen(word));
	t->len += strlen(word);
	if (t->at < t->end && !strcmp(word, "END_ACTION"))
		return;
	t->out[t->len++] = '\n';
}

/* `ACTION Name:` in place of `<Action Name="Name" …`. */
static void put_action(struct twincat *t, size_t at, const char *tag, const char *to)
{
	static const char word[] = "ACTION";
	const char *name = find(tag, to, "Name=\""), *quote;

	if (!name)
		return;
	name += strlen("Name=\"");
	quote = memchr(name, '"', (size_t)(to - name));
	if (!quote)
		return;
	memcpy(t->out + at + 1, word, strlen(word));
	memcpy(t->out + at + (name - tag), name, (size_t)(quote - name));
	t->out[at + (size_t)(quote - tag)] = ':';
}

static void close_element(struct twincat *t)
{
	if (!t->depth) {
		damaged(t, "<TcPlcObject>");
		return;
	}
	t->depth--;
	if (t->skip > t->depth)
		t->skip = 0;
	if (t->open[t->depth] == ELEMENT_ACTION && !t->skip)
		put_end(t, "END_ACTION");
	if (t->open[t->depth] != ELEMENT_POU || !t->close)
		return;
	put_end(t, t->close);
	t->close = NULL;
}

static void read_tag(struct twincat *t)
{
	const char *to = end_of_tag(t), *name = t->at + 1;
	size_t len = 0;

	if (!to) {
		damaged(t, ">");
		return;
	}
	if (*name == '/') {
		close_element(t);
		pass(t, to);
		return;
	}
	while (name + len < to && !strchr(" \t\r\n/>", name[len]))
		len++;
	if (to[-2] != '/') {
		if (t->depth == DEPTH_MOST) {
			damaged(t, "</…>");
			return;
		}
		t->open[t->depth] = element_of(t, name, len, to);
		t->depth++;
		if (!t->skip && t->open[t->depth - 1] == ELEMENT_SKIP)
			t->skip = t->depth;
	}
	const size_t at = t->len;
	const char *tag = t->at;

	pass(t, to);
	if (to[-2] != '/' && t->open[t->depth - 1] == ELEMENT_ACTION)
		put_action(t, at, tag, to);
}

static void read_markup(struct twincat *t)
{
	const char *to;

	if (begins(t, "<![CDATA[")) {
		read_cdata(t);
	} else if (begins(t, "<!--") || begins(t, "<?")) {
		to = begins(t, "<?") ? find(t->at, t->end, "?>") : find(t->at + 4, t->end, "-->");
		if (to)
			pass(t, to + (*to == '?' ? 2 : 3));
		else
			damaged(t, *(t->at + 1) == '?' ? "?>" : "-->");
	} else if (begins(t, "<!")) {
		damaged(t, "<TcPlcObject>");
	} else {
		read_tag(t);
	}
}

size_t twincat_text(const char *file, const char *bytes, size_t len, char *out,
		    struct diag_list *diags)
{
	struct twincat t = { .at = bytes, .end = bytes + len, .begin = bytes, .out = out,
			     .place = { .file = file }, .diags = diags };

	while (t.at < t.end && !t.broken) {
		if (*t.at == '<')
			read_markup(&t);
		else
			read_characters(&t);
	}
	if (t.depth && !t.broken)
		damaged(&t, "</TcPlcObject>");
	out[t.len] = '\0';
	return t.len;
}

/* ---- lists of global variables ---- */

/* The name in <GVL Name="…">; NULL: the file is no such list. */
static const char *list_name(const struct text_file *file, size_t *len)
{
	static const char ending[] = ".TcGVL", head[] = "<GVL Name=\"";
	const size_t name_len = strlen(file->name), ending_len = strlen(ending);
	const char *end = file->text + (file->len < 1024 ? file->len : 1024), *name, *quote;

	if (name_len < ending_len ||
	    !ascii_is(ending, file->name + name_len - ending_len, ending_len))
		return NULL;
	name = find(file->text, end, head);
	name = name ? name + strlen(head) : end;
	quote = memchr(name, '"', (size_t)(end - name));
	*len = quote ? (size_t)(quote - name) : 0;
	return quote ? name : NULL;
}

/* Which file is the list that "Lights.Red" begins with; -1: none. @len: gets the bytes of "Lights". */
static int list_in(const struct text_file *files, int count, const struct token *token, size_t *len)
{
	const char *dot = memchr(token->text, '.', token->len);

	*len = dot ? (size_t)(dot - token->text) : token->len;
	for (int i = 0; i < count && token->kind == TOKEN_NAME; i++) {
		size_t name_len = 0;
		const char *name = list_name(&files[i], &name_len);

		if (name && name_len == *len && ascii_same(name, token->text, *len))
			return i;
	}
	return -1;
}

/* Does `Lights : …` or `Lights, … : …` stand in the text? */
static bool is_declared(const char *text, size_t text_len, const char *name, size_t len)
{
	struct lex lex;
	bool named = false;

	lex_init(&lex, text, text_len);
	while (lex_next(&lex) != TOKEN_END) {
		if (named && (lex_is(&lex, ":") || lex_is(&lex, ",")))
			return true;
		named = lex.token.kind == TOKEN_NAME && lex.token.len == len &&
			ascii_same(lex.token.text, name, len);
	}
	return false;
}

/* @declared: of each file, 0: not known yet. */
static bool is_list(const char *text, size_t text_len, const char *name, size_t len, char *declared)
{
	if (!*declared)
		*declared = is_declared(text, text_len, name, len) ? 'y' : 'n';
	return *declared == 'n';
}

void twincat_blank_lists(const struct text_file *files, int count, char *text, size_t len)
{
	char *declared = calloc((size_t)count, 1);
	bool member = false; /* a point stands before the token */
	struct lex lex;

	lex_init(&lex, text, len);
	for (enum token_kind kind = declared ? lex_next(&lex) : TOKEN_END; kind != TOKEN_END;) {
		const struct token token = lex.token;
		size_t list_len = 0;
		const int list = member ? -1 : list_in(files, count, &token, &list_len);
		bool apart;

		kind = lex_next(&lex);
		apart = list_len == token.len;
		member = token.len == 1 && *token.text == '.';
		if (list < 0 || (apart && !lex_is(&lex, ".")) ||
		    !is_list(text, len, token.text, list_len, &declared[list]))
			continue;
		memset(text + (token.text - text), ' ', list_len + !apart);
		if (!apart)
			continue;
		text[lex.token.text - text] = ' ';
		kind = lex_next(&lex);
		member = true; /* it stood there */
	}
	free(declared);
}
