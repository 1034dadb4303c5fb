/* SPDX-License-Identifier: MIT
 *
 * mend_habits - a row as people type it who know other controllers; see mend_habits.h.
 *
 * Each habit looks at one cell and changes it once; the cell is looked at again until none does.
 */
#include "engine/text/mend_habits.h"
#include "engine/text/mend_number.h"

#include "engine/base/ascii.h"
#include "engine/base/iec.h"

#include <stdio.h>
#include <string.h>

#define COUNT(table) (sizeof(table) / sizeof((table)[0]))
#define MADE 200    /* longer than any row                                     */
#define PIECES 24   /* of one cell                                             */
#define QUOTED sizeof(((struct mended *)NULL)->from)
#define AGAIN 12    /* changes of one cell                                     */

struct piece {
	size_t at, len;
};

struct habits {
	struct project *project;
	struct mended *out;
	char *text;
	size_t size, from, to;      /* of the cell                            */
	struct piece piece[PIECES]; /* of the cell                             */
	int count;
	bool changed, full;
};

/* ---- a row and its cells ---- */

/* For a message: without blanks at its end, and with … if it has no room. @out: as in struct mended. */
static void quote(char *out, const char *text, size_t len)
{
	const size_t most = QUOTED - sizeof("…");

	while (len > 1 && text[len - 1] == ' ')
		len--;
	snprintf(out, QUOTED, "%.*s%s", (int)(len > most ? utf8_cut(text, most) : len), text,
		 len > most ? "…" : "");
}

/* Puts @with in the place of @len bytes at @at. The first change is told. */
static bool put(struct habits *h, size_t at, size_t len, const char *with)
{
	const size_t all = strlen(h->text), add = strlen(with);
	size_t lead = strspn(with, " "), blanks = 0;

	if (all - len + add >= h->size) {
		h->full = true;
		return false;
	}
	if (!h->changed) {
		*h->out = (struct mended){ .id = !len ? DIAG_MISSING : !add ? DIAG_SURPLUS : DIAG_WRITE_INSTEAD,
					   .column = (int)(at + (len ? strspn(h->text + at, " ") : 0)) + 1 };
		for (; len > 1 && h->text[at] == ' '; len--, blanks++)
			at++;
		quote(h->out->from, h->text + at, len);
		at -= blanks;
		len += blanks;
		quote(h->out->to, with + lead, strlen(with + lead));
	}
	h->changed = true;
	memmove(h->text + at + add, h->text + at + len, all - at - len + 1);
	memcpy(h->text + at, with, add);
	return true;
}

/* Takes the brackets at both ends of a text away. */
static bool unwrap(struct habits *h, size_t at, size_t len)
{
	return put(h, at, 1, "") && put(h, at + len - 2, 1, "");
}

/* Behind the comment or the quoted text at @at; @at: none begins there. */
static size_t skip(const char *text, size_t at)
{
	const bool comment = text[at] == '(' && text[at + 1] == '*';
	const char *end = comment ? strstr(text + at + 2, "*)") : NULL;

	if (text[at] == '/' && text[at + 1] == '/')
		return strlen(text);
	if (text[at] == '\'' || text[at] == '"')
		end = strchr(text + at + 1, text[at]);
	return end ? (size_t)(end - text) + 1 + comment : at;
}

/* The next bar from byte @at on, outside of brackets that are closed in this row. */
static size_t next_bar(const char *text, size_t at)
{
	while (text[at] && text[at] != '|') {
		const size_t behind = skip(text, at);
		const char *close = text[at] == '[' ? strchr(text + at, ']') : NULL;
		const char *other = close ? strchr(text + at + 1, '[') : NULL;

		at = behind != at ? behind : close && (!other || other > close) ? (size_t)(close - text) : at + 1;
	}
	return at;
}

static bool stands(char c)
{
	return c && strchr("(),;", c);
}

/* A word, an operand or a sign: what stands between blanks, but (, ), a comma, := and => stand alone. */
static size_t piece_length(const char *text, size_t at, size_t to)
{
	size_t len = 0;

	if (stands(text[at]))
		return 1;
	if ((text[at] == ':' || text[at] == '=') && at + 1 < to && strchr("=>", text[at + 1]) && text[at + 1])
		return 2;
	while (at + len < to && text[at + len] != ' ' && !stands(text[at + len]) &&
	       !(len && text[at + len] == ':' && text[at + len + 1] == '=') &&
	       !(len && text[at + len] == '=' && text[at + len + 1] == '>'))
		len++;
	return len;
}

/* Finds cell @n without blanks and its comment, and its pieces. False: there is no such cell. */
static bool cell_open(struct habits *h, int n)
{
	size_t at = *h->text == '|', to = next_bar(h->text, at);

	for (; n > 0 && h->text[to] == '|'; n--) {
		at = to + 1;
		to = next_bar(h->text, at);
	}
	if (n > 0 || !h->text[at])
		return false;
	at += strspn(h->text + at, " ");
	for (size_t i = at; i < to; i++)
		if (skip(h->text, i) != i && h->text[i] != '\'' && h->text[i] != '"')
			to = i;
	while (to > at && h->text[to - 1] == ' ')
		to--;
	h->from = at;
	h->to = to;
	for (h->count = 0; at < to && h->count < PIECES; h->count++) {
		h->piece[h->count] = (struct piece){ at, piece_length(h->text, at, to) };
		at += h->piece[h->count].len;
		at += strspn(h->text + at, " ");
	}
	if (at < to) /* too long to be looked at */
		h->count = 0;
	return true;
}

static const char *text_of(const struct habits *h, int i)
{
	return h->text + h->piece[i].at;
}

static size_t end_of(const struct habits *h, int i)
{
	return h->piece[i].at + h->piece[i].len;
}

static bool is(const struct habits *h, int i, const char *word)
{
	return i < h->count && ascii_is(word, text_of(h, i), h->piece[i].len);
}

static bool is_one_of(const struct habits *h, int i, const char *const *words, size_t count)
{
	bool found = false;

	for (size_t n = 0; n < count && words[n] && !found; n++)
		found = is(h, i, words[n]);
	return found;
}

static bool is_number(const struct habits *h, int i)
{
	const size_t len = i < h->count ? h->piece[i].len : 0;

	return len && strspn(text_of(h, i), "0123456789") >= len;
}

/* A name with its path, or an address. */
static bool is_operand(const struct habits *h, int i)
{
	const char *text = i < h->count ? text_of(h, i) : "";

	return (mend_is_word(*text) && !ascii_digit(*text)) || *text == '%' || *text == '#' || *text == '"';
}

static bool is_joiner(const struct habits *h, int i)
{
	static const char *const words[] = { "AND", "OR", "&", "," };

	return is_one_of(h, i, words, COUNT(words));
}

/* ---- several elements in a cell ---- */

static const char *const contacts[] = { "NO", "NC", "XIC", "XIO" };
static const char *const elements[] = {
	"NO", "NC", "XIC", "XIO", "COIL", "OTE", "OTL", "OTU", "OUT", "SET", "RST", "LD", "LDI", "S", "R",
	"TON", "TOF", "RTO", "CTU", "CTD", "MOV",
};

/* The piece behind the element that begins at piece @i, with its operand or its parentheses; 0: there is none. */
static int element_end(const struct habits *h, int i)
{
	int depth = 0;

	if (!is_one_of(h, i, elements, COUNT(elements)))
		return 0;
	if (!is(h, i + 1, "("))
		return is_operand(h, i + 1) && !is_joiner(h, i + 1) ? i + 2 : 0;
	for (i++; i < h->count; i++) {
		depth += is(h, i, "(") - is(h, i, ")");
		if (depth == 0)
			return i + 1;
	}
	return 0;
}

/* NO A OR NC B → [ A OR NOT B ]: contacts without parentheses, of which at least two are joined by OR. */
static bool join_branches(struct habits *h)
{
	char made[MADE] = "[ ";
	size_t used = 2;
	bool any = false;
	int i = 0;

	for (; i < h->count && used < MADE; i += 3) {
		const bool off = is(h, i, "NC") || is(h, i, "XIO");

		if (!is_one_of(h, i, contacts, COUNT(contacts)) || element_end(h, i) != i + 2)
			return false;
		used += (size_t)snprintf(made + used, sizeof(made) - used, "%s%.*s ", off ? "NOT " : "",
					 (int)h->piece[i + 1].len, text_of(h, i + 1));
		if (i + 2 >= h->count || used >= MADE)
			break;
		if (!is_joiner(h, i + 2) || is(h, i + 2, ","))
			return false;
		any = any || is(h, i + 2, "OR");
		used += (size_t)snprintf(made + used, sizeof(made) - used, "%s ", is(h, i + 2, "OR") ? "OR" : "AND");
	}
	if (!any || i + 2 != h->count || used + 2 >= MADE)
		return false;
	snprintf(made + used, sizeof(made) - used, "]");
	return put(h, h->from, h->to - h->from, made);
}

/* BST XIC A NXB XIC B BND → [ A OR B ] |, and what stands behind it is another cell. */
static bool join_logix(struct habits *h)
{
	char made[MADE] = "[ ";
	size_t used = 2;
	int i = 0;

	if (!is(h, 0, "BST"))
		return false;
	for (; (is(h, i, "BST") || is(h, i, "NXB")) && used < MADE; i += 3) {
		if (!is_one_of(h, i + 1, contacts, COUNT(contacts)) || !is_operand(h, i + 2))
			return false;
		used += (size_t)snprintf(made + used, sizeof(made) - used, "%s%s%.*s ", i ? "OR " : "",
					 is(h, i + 1, "XIO") || is(h, i + 1, "NC") ? "NOT " : "",
					 (int)h->piece[i + 2].len, text_of(h, i + 2));
	}
	if (!is(h, i, "BND") || used + 4 >= MADE)
		return false;
	snprintf(made + used, sizeof(made) - used, "%s", i + 1 < h->count ? "] |" : "]");
	return put(h, h->from, end_of(h, i) - h->from, made);
}

/* XIC(A)OTE(B), NO A NO B, NO A AND NC B: a bar stands between two elements. */
static bool part_elements(struct habits *h)
{
	const int end = element_end(h, 0);
	const bool joined = end && is_joiner(h, end);

	if (!end || end + joined >= h->count || is(h, end, "OR") || !element_end(h, end + joined))
		return false;
	if (joined)
		return put(h, h->piece[end].at, h->piece[end].len, is(h, end, ",") ? " |" : "|");
	return put(h, end_of(h, end - 1), 0, h->text[end_of(h, end - 1)] == ' ' ? " |" : " | ");
}

/* NO A / COIL B, NO A I COIL B: a sign or letter that looks like a bar. */
static bool bar_of_other(struct habits *h)
{
	const int end = element_end(h, 0);

	if (!end || end >= h->count || h->piece[end].len != 1 || !strchr("\\/Il!:;1", *text_of(h, end)) ||
	    !is_one_of(h, end + 1, elements, COUNT(elements)))
		return false;
	return put(h, h->piece[end].at, 1, "|");
}

/* ---- constants ---- */

/* TRUE and 1 are a wire, 0 a contact that is never closed. */
static bool name_constant(struct habits *h)
{
	const bool word = is(h, 0, "NO") || is(h, 0, "NC");
	const int at = word ? 1 : 0;
	const bool on = is(h, at, "1"), off = is(h, at, "0"), named = is(h, at, "TRUE") || is(h, at, "FALSE");

	if (h->count != at + 1 || (!on && !off && (word || !named)))
		return false;
	if (word)
		return put(h, h->piece[1].at, 1, on ? "TRUE" : "FALSE");
	return put(h, h->from, h->to - h->from, on || is(h, 0, "TRUE") ? "---" : "NO FALSE");
}

/* A wire is drawn with three dashes; nothing to do is a wire, too. */
static bool draw_wire(struct habits *h)
{
	const size_t len = h->to - h->from;

	if (len == 0 || (strspn(h->text + h->from, "-+_.=~") < len && !(h->count == 1 && is(h, 0, "NOP"))))
		return false;
	if (strspn(h->text + h->from, "-") >= len)
		return false;
	return put(h, h->from, len, "---");
}

/* ---- timers and counters ---- */

struct block {
	const char *word, *ours;
	const char *preset;
};

static const struct block *block_at(const struct habits *h, int i)
{
	static const struct block blocks[] = {
		{ "TON", "TON", "PT" }, { "TOF", "TOF", "PT" }, { "TP", "TP", "PT" }, { "RTO", "TONR", "PT" },
		{ "S_ODT", "TON", "PT" }, { "S_OFFDT", "TOF", "PT" }, { "S_PULSE", "TP", "PT" },
		{ "CTU", "CTU", "PV" }, { "CTD", "CTD", "PV" }, { "S_CU", "CTU", "PV" }, { "S_CD", "CTD", "PV" },
	};

	for (size_t n = 0; n < COUNT(blocks); n++)
		if (is(h, i, blocks[n].word))
			return &blocks[n];
	return NULL;
}

static bool is_timer(const struct block *block)
{
	return block->preset[1] == 'T';
}

/* @value in units of @unit ms. */
static void print_preset(const struct block *block, unsigned long value, unsigned long unit, char *out, size_t size)
{
	if (!is_timer(block))
		snprintf(out, size, "PV:=%lu", value);
	else if (value * unit % 1000 == 0)
		snprintf(out, size, "PT:=T#%lus", value * unit / 1000);
	else
		snprintf(out, size, "PT:=T#%lums", value * unit);
}

static unsigned long number_at(const char *text)
{
	unsigned long value = 0;

	while (ascii_digit(*text) && value < 100000000)
		value = 10 * value + (unsigned long)(*text++ - '0');
	return value;
}

/* TON(Delay,5000,0), TON Delay 5000 0: Logix gives the preset, a timer's in milliseconds, and the value to begin with. */
static bool preset_of_logix(struct habits *h)
{
	const struct block *block = block_at(h, 0);
	const bool open = is(h, 1, "("), comma = is(h, 2 + open, ",");
	const int name = 1 + open, preset = name + 1 + comma, first = preset + 1 + comma;
	char value[32], made[MADE];

	if (!block || !is_operand(h, name) || !is_number(h, preset) || !is(h, first, "0") ||
	    h->count != first + 1 + open || (open && !is(h, first + 1, ")")))
		return false;
	print_preset(block, number_at(text_of(h, preset)), 1, value, sizeof(value));
	if (!open)
		return put(h, h->piece[preset].at, h->to - h->piece[preset].at, value);
	snprintf(made, sizeof(made), " %.*s %s", (int)h->piece[name].len, text_of(h, name), value);
	return put(h, h->piece[1].at, h->to - h->piece[1].at, made);
}

/* The letter of a timer's or counter's name. */
static const char *block_letter(const struct block *block)
{
	return !block || is_timer(block) ? "T" : "C";
}

/* Of K50 the digits; NULL: it is no such constant. */
static const char *constant_of_mitsubishi(const struct habits *h, int i)
{
	const char *text = i < h->count ? text_of(h, i) : "";
	const size_t len = i < h->count ? h->piece[i].len : 0;

	return len > 1 && ascii_upper(*text) == 'K' && strspn(text + 1, "0123456789") == len - 1 ? text + 1 : NULL;
}

/* OUT T0 K50 and TON T0 K50: tenths of a second; OUT C0 K10: a count. MOV K100 D0: a number. */
static bool take_constant(struct habits *h)
{
	static const struct block timer = { "OUT", "TON", "PT" }, counter = { "OUT", "CTU", "PV" };
	const struct block *block = block_at(h, 0);
	const char *digits = constant_of_mitsubishi(h, 2);
	char value[32], made[MADE];

	if (is(h, 0, "OUT") && h->count == 3)
		block = ascii_upper(*text_of(h, 1)) == 'T' ? &timer : ascii_upper(*text_of(h, 1)) == 'C' ? &counter : NULL;
	if (block && digits && h->count == 3) {
		print_preset(block, number_at(digits), 100, value, sizeof(value));
		snprintf(made, sizeof(made), "%s %.*s %s", block->ours, (int)h->piece[1].len, text_of(h, 1), value);
		return put(h, h->from, h->to - h->from, made);
	}
	for (int i = 1; i < h->count; i++) {
		digits = constant_of_mitsubishi(h, i);
		if (digits && (is(h, 0, "MOV") || is(h, 0, "MOVE") || is(h, 0, "ADD") || is(h, 0, "SUB") || is(h, 0, "MUL") ||
			       is(h, 0, "DIV")))
			return put(h, h->piece[i].at, 1, "");
	}
	return false;
}

/* S5T#5s → T#5s, 00:00:05 → T#5s behind the :=. */
static bool take_time(struct habits *h)
{
	char made[32];

	for (int i = 1; i < h->count; i++) {
		const char *text = text_of(h, i);
		const size_t len = h->piece[i].len;

		if (len > 4 && ascii_same(text, "S5T#", 4))
			return put(h, h->piece[i].at, 2, "");
		if (len > 7 && ascii_same(text, "S5TIME#", 7))
			return put(h, h->piece[i].at, 7, "T#");
		if ((len == 4 || len == 5) && text[len - 3] == ':' && strspn(text, "0123456789:") >= len && is(h, i - 1, ":=")) {
			snprintf(made, sizeof(made), "T#%lus", 60 * number_at(text) + number_at(text + len - 2));
			return put(h, h->piece[i].at, len, made);
		}
		if (len == 8 && text[2] == ':' && text[5] == ':' && strspn(text, "0123456789:") >= 8 &&
		    (is(h, i - 1, ":=") || i == 2)) {
			const unsigned long all = 3600 * number_at(text) + 60 * number_at(text + 3) + number_at(text + 6);

			snprintf(made, sizeof(made), "T#%lus", all);
			return put(h, h->piece[i].at, len, made);
		}
	}
	return false;
}

/* S_ODT T1 … → TON T1 … */
static bool name_block(struct habits *h)
{
	const struct block *block = block_at(h, 0);

	return block && h->count > 1 && h->text[h->from + 1] == '_' &&
	       put(h, h->from, h->piece[0].len, block->ours);
}

/* Is the word a function block of the catalogue or the project? */
static const struct word_row *block_word(const struct habits *h, int i)
{
	struct word_table *words = &h->project->words;
	const enum word word = i < h->count ? words_find(words, text_of(h, i), h->piece[i].len) : WORD_COUNT;
	const struct word_row *row = words_row(words, word);

	return word != WORD_COUNT && row->kind == WORD_FB ? row : NULL;
}

/* Does the project or this POU have a variable that is a block of this word? Its name; NULL: none. */
static const char *instance_of(const struct habits *h, const char *word)
{
	const struct project *project = h->project;
	const struct pou *pou = project->pou_count ? &project->pou[project->pou_count - 1] : NULL;
	const struct var_table *tables[] = { pou ? &pou->vars : &project->globals, &project->globals };

	for (size_t n = 0; n < COUNT(tables); n++)
		for (int k = 0; k < tables[n]->count; k++) {
			const struct var *var = &tables[n]->var[k];

			if (var->type == IEC_NONE && var->fb != WORD_COUNT &&
			    strcmp(words_row(&project->words, var->fb)->word, word) == 0)
				return project_text(project, var->name);
		}
	return NULL;
}

/* A name for a block that has none yet. */
static const char *usual_name(const char *word)
{
	static const char *const names[][2] = {
		{ "TON", "Delay" }, { "TOF", "Delay" }, { "TONR", "Delay" }, { "TP", "Pulse" }, { "CTU", "Parts" }, { "CTD", "Parts" },
		{ "CTUD", "Parts" }, { "R_TRIG", "Rise" }, { "F_TRIG", "Fall" }, { "SR", "Latch" }, { "RS", "Latch" },
	};

	for (size_t n = 0; n < COUNT(names); n++)
		if (strcmp(names[n][0], word) == 0)
			return names[n][1];
	return "Block1";
}

static bool is_constant(const struct habits *h, int i)
{
	const char *text = i < h->count ? text_of(h, i) : "";

	return ascii_digit(*text) || ascii_same(text, "T#", 2) || ascii_same(text, "TIME#", 5);
}

/* TON PT:=T#5s Delay and CTU 9 Parts: the name stands first. Without any name, TON PT:=T#5s, one is needed. */
static bool name_first(struct habits *h)
{
	const struct word_row *row = block_word(h, 0);
	const int last = h->count - 1;
	const bool pin = is(h, 2, ":=") || is(h, 2, "=>");
	const char *name = row ? instance_of(h, row->word) : NULL;
	char made[MADE];

	if (!row || !(h->count == 1 || pin || is_constant(h, 1)))
		return false;
	if (last > 1 && is_operand(h, last) && !is_constant(h, last) && !is(h, last - 1, ":=") && !is(h, last - 1, "=>")) {
		snprintf(made, sizeof(made), "%.*s %.*s", (int)h->piece[last].len, text_of(h, last),
			 (int)(end_of(h, last - 1) - h->piece[1].at), text_of(h, 1));
		return put(h, h->piece[1].at, h->to - h->piece[1].at, made);
	}
	if (h->changed)
		return false;
	name = name ? name : usual_name(row->word);
	snprintf(made, sizeof(made), " %.40s", name);
	if (!put(h, end_of(h, 0), 0, made))
		return false;
	h->out->id = DIAG_MISSING_INSTANCE;
	h->out->column = (int)h->from + 1;
	quote(h->out->from, row->word, strlen(row->word));
	snprintf(made, sizeof(made), "%s %.40s", row->word, name);
	quote(h->out->to, made, strlen(made));
	return true;
}

/* TON Delay PT:= gets a value to begin with; CTU Parts CU:= has the power of the row there. */
static bool fill_pin(struct habits *h)
{
	const struct word_row *row = block_word(h, 0);
	int pin = -1, i;

	for (i = 2; row && i + 1 < h->count; i++)
		if (is(h, i + 1, ":=") && (i + 2 == h->count || is(h, i + 3, ":=") || is(h, i + 3, "=>"))) {
			pin = word_pin_find(row, text_of(h, i), h->piece[i].len);
			break;
		}
	if (pin < 0 || pin >= row->pin_count || row->pin[pin].dir != PIN_IN || h->changed)
		return false;
	if (row->pin[pin].type == IEC_BOOL)
		return put(h, end_of(h, i - 1), end_of(h, i + 1) - end_of(h, i - 1), "");
	if (!put(h, end_of(h, i + 1), 0, row->pin[pin].type == IEC_TIME ? "T#1s" : "1"))
		return false;
	h->out->id = DIAG_VALUE_MISSING;
	quote(h->out->from, row->pin[pin].name, strlen(row->pin[pin].name));
	return true;
}

/* P alone: the edge of the power before it. */
static bool edge_of_power(struct habits *h)
{
	const bool rising = is(h, 0, "P");

	if (h->count != 1 || h->changed || (!rising && !is(h, 0, "N")) ||
	    !put(h, h->from, 1, rising ? "R_TRIG Rise" : "F_TRIG Fall"))
		return false;
	h->out->id = DIAG_EDGE_OF_VALUE;
	snprintf(h->out->to, sizeof(h->out->to), rising ? "Rise : R_TRIG" : "Fall : F_TRIG");
	return true;
}

/* ONS Bit: the edge of the power before it, which Logix keeps in a bit. In front of a row it is P. */
static bool edge_of_logix(struct habits *h)
{
	static const char *const words[] = { "ONS", "OSR", "OSF" };

	return h->count == 2 && is_one_of(h, 0, words, COUNT(words)) && h->from > 2 + (size_t)(*h->text == '|') &&
	       put(h, h->from, h->to - h->from, is(h, 0, "OSF") ? "F_TRIG Fall" : "R_TRIG Rise");
}

/* Words that compare, and what they are called elsewhere. */
static const struct { const char *word, *other, *sign; } tests[] = {
	{ "EQ", "EQU", "=" }, { "NE", "NEQ", "<>" }, { "GT", "GRT", ">" }, { "GE", "GEQ", ">=" }, { "LT", "LES", "<" },
	{ "LE", "LEQ", "<=" },
};

/* The sign of a comparison in a cell, from byte @at on; *@len: its bytes, 0: none. */
static size_t find_sign(const struct habits *h, size_t at, size_t *len)
{
	for (; at < h->to && !strchr("<>=:", h->text[at]); at++)
		;
	*len = at < h->to ? strspn(h->text + at, "<>=:") : 0;
	return at;
}

/* EQ A := 5, EQ A = 5, GT A > 5 → EQ IN1:=A IN2:=5; CMP A = B → [ A = B ]. */
static bool compare_word(struct habits *h)
{
	const bool any = is(h, 0, "CMP");
	size_t len, more, at = find_sign(h, h->from, &len), end = at;
	char sign[4], made[MADE];
	size_t n = 0;

	while (n < COUNT(tests) && !is(h, 0, tests[n].word) && !is(h, 0, tests[n].other))
		n++;
	if ((!any && n == COUNT(tests)) || h->count < 2 || !len || len > 2 || is(h, 1, "(") ||
	    (!any && (find_sign(h, at + len, &more) < h->to || ascii_same(text_of(h, 1), "IN", 2))))
		return false;
	if (any) {
		snprintf(made, sizeof(made), "[ %.*s ]", (int)(h->to - h->piece[1].at), text_of(h, 1));
		return put(h, h->from, h->to - h->from, made);
	}
	snprintf(sign, sizeof(sign), "%.*s", (int)len, h->text + at);
	if (strcmp(sign, ":=") != 0 && strcmp(sign, "=") != 0 && strcmp(sign, "==") != 0 && strcmp(sign, tests[n].sign) != 0)
		return false;
	while (end > h->piece[1].at && h->text[end - 1] == ' ')
		end--;
	at += len + strspn(h->text + at + len, " ");
	if (end <= h->piece[1].at || at >= h->to || h->text[end - 1] == '!')
		return false;
	snprintf(made, sizeof(made), "%s IN1:=%.*s IN2:=%.*s", tests[n].word, (int)(end - h->piece[1].at), text_of(h, 1),
		 (int)(h->to - at), h->text + at);
	return put(h, h->from, h->to - h->from, made);
}

/* TON Delay, PT:=T#5s and TON Delay [PT:=T#5s]: the values stand behind the name without anything around them. */
static bool bare_values(struct habits *h)
{
	if (!block_word(h, 0) || h->count < 4)
		return false;
	if (is(h, 2, ",") && !is(h, 1, "("))
		return put(h, h->piece[2].at, 1, "");
	if (*text_of(h, 2) != '[' || h->text[h->to - 1] != ']' || !h->piece[1].len || h->text[end_of(h, 1)] != ' ')
		return false;
	return unwrap(h, h->piece[2].at, h->to - h->piece[2].at);
}

/* The input that takes the power of the row; NULL: none does. */
static const char *power_pin(const struct word_row *row)
{
	for (int i = 0; i < row->pin_count; i++)
		if (row->pin[i].dir == PIN_IN)
			return row->pin[i].type == IEC_BOOL ? row->pin[i].name : NULL;
	return NULL;
}

/* TON Delay (IN:=Start, PT:=T#5s): the power comes from a contact before the block, the others have no comma. */
static bool call_block(struct habits *h)
{
	const struct word_row *row = block_word(h, 0);
	const char *power = row ? power_pin(row) : NULL;
	char made[MADE] = "", contact[MADE] = "";
	size_t used = 0;
	int i = 3;

	if (!row || h->count < 6 || !is(h, 2, "(") || !is(h, h->count - 1, ")"))
		return false;
	for (; i + 2 < h->count && used < MADE; i += 4) {
		const bool sets = is(h, i + 1, ":="), negated = is(h, i + 2, "NOT");
		const size_t value = h->piece[i + 2 + negated].len;

		if ((!sets && !is(h, i + 1, "=>")) || i + 3 + negated >= h->count ||
		    (!is(h, i + 3 + negated, ",") && i + 4 + negated != h->count) || value >= MADE / 2)
			return false;
		if (sets && power && is(h, i, power))
			snprintf(contact, sizeof(contact), "%s %.*s | ", negated ? "NC" : "NO", (int)value,
				 text_of(h, i + 2 + negated));
		else if (negated)
			return false;
		else
			used += (size_t)snprintf(made + used, sizeof(made) - used, " %.*s%s%.*s", (int)h->piece[i].len,
						 text_of(h, i), sets ? ":=" : "=>", (int)value, text_of(h, i + 2));
		i += negated;
	}
	if (used >= MADE)
		return false;
	/* The same contact may stand there already. */
	if (*contact && h->from >= strlen(contact) && !strncmp(h->text + h->from - strlen(contact), contact, strlen(contact)))
		*contact = '\0';
	return put(h, end_of(h, 1), h->to - end_of(h, 1), made) && (!*contact || put(h, h->from, 0, contact));
}

static bool is_pin(const struct word_row *row, const struct habits *h, int i)
{
	bool found = false;

	for (int pin = 0; pin < row->pin_count && !found; pin++)
		found = is(h, i, row->pin[pin].name);
	return found;
}

/* CTU Parts R Reset PV 5 → CTU Parts R:=Reset PV:=5; CTU Parts CU:= → CTU Parts. */
static bool join_pins(struct habits *h)
{
	const struct word_row *row = block_word(h, 0);
	char made[MADE];

	for (int i = 2; row && i < h->count && h->to - h->from < MADE; i++) {
		const bool set = is(h, i + 1, ":=") || is(h, i + 1, "=>");

		if (!is_pin(row, h, i) || is(h, i - 1, ":=") || is(h, i - 1, "=>"))
			continue;
		if (set && i + 2 == h->count)
			return put(h, end_of(h, i - 1), h->to - end_of(h, i - 1), "");
		if (set || i + 1 >= h->count || is_pin(row, h, i + 1) || (!is_operand(h, i + 1) && !ascii_digit(*text_of(h, i + 1))))
			continue;
		snprintf(made, sizeof(made), "%.*s:=%.*s", (int)h->piece[i].len, text_of(h, i), (int)h->piece[i + 1].len,
			 text_of(h, i + 1));
		return put(h, h->piece[i].at, end_of(h, i + 1) - h->piece[i].at, made);
	}
	return false;
}

/* GT A > 5, ADD A + B: the word says it already. MOVE A := 5 stores into A. */
static bool drop_sign(struct habits *h)
{
	static const char *const signs[][5] = {
		{ "EQ", "=", "==" }, { "NE", "<>", "!=", "#" }, { "GT", ">" }, { "LT", "<" }, { "GE", ">=", "=>" }, { "LE", "<=", "=<" },
		{ "ADD", "+" }, { "SUB", "-" }, { "MUL", "*", "X" }, { "DIV", "/" }, { "AND", "&" },
	};
	const bool store = is(h, 0, "MOVE") && (is(h, 2, ":=") || is(h, 2, "=")), turn = store && !is(h, 1, "IN");
	const bool on = is(h, 0, "MOVE") && is(h, 2, "=>");
	char made[MADE];
	bool said = false;

	if (h->count != 4 || h->to - h->from >= MADE / 3)
		return false;
	for (size_t i = 0; i < COUNT(signs) && !said; i++)
		said = is(h, 0, signs[i][0]) && is_one_of(h, 2, signs[i] + 1, 4) && !is(h, 1, "IN1");
	if (!said && !turn && !on)
		return false;
	snprintf(made, sizeof(made), said ? "%.*s IN1:=%.*s IN2:=%.*s" : "%.*s IN:=%.*s OUT=>%.*s", (int)h->piece[0].len, text_of(h, 0),
		 (int)h->piece[turn ? 3 : 1].len, text_of(h, turn ? 3 : 1), (int)h->piece[turn ? 1 : 3].len, text_of(h, turn ? 1 : 3));
	return put(h, h->from, h->to - h->from, made);
}

/* Delay TON PT:=T#5s → TON Delay PT:=T#5s. */
static bool turn_name(struct habits *h)
{
	char made[MADE];

	if (h->count < 4 || !is(h, 3, ":=") || !block_word(h, 1) || block_word(h, 0) || !mend_is_word(*text_of(h, 0)) ||
	    words_find(&h->project->words, text_of(h, 0), h->piece[0].len) != WORD_COUNT)
		return false;
	snprintf(made, sizeof(made), "%.*s %.*s", (int)h->piece[1].len, text_of(h, 1), (int)h->piece[0].len, text_of(h, 0));
	return put(h, h->from, end_of(h, 1) - h->from, made);
}

/* The block that a variable of this POU or of the project is; NULL: none. */
static const char *block_of(const struct habits *h, int i)
{
	const struct project *project = h->project;
	const struct pou *pou = project->pou_count ? &project->pou[project->pou_count - 1] : NULL;
	const struct var_table *tables[] = { pou ? &pou->vars : &project->globals, &project->globals };

	for (size_t n = 0; n < COUNT(tables); n++)
		for (int k = 0; k < tables[n]->count; k++) {
			const struct var *var = &tables[n]->var[k];

			if (var->type == IEC_NONE && var->fb != WORD_COUNT &&
			    ascii_is(project_text(project, var->name), text_of(h, i), h->piece[i].len) &&
			    words_row(&h->project->words, var->fb)->kind == WORD_FB)
				return words_row(&h->project->words, var->fb)->word;
		}
	return NULL;
}

/* Delay PT:=T#5s, Delay(PT:=T#5s): the word of the block is missing. */
static bool add_word(struct habits *h)
{
	const char *word = h->count >= 3 && (is(h, 2, ":=") || (is(h, 1, "(") && is(h, 3, ":="))) ? block_of(h, 0) : NULL;
	char made[MADE];

	if (!word || strlen(word) + 2 > sizeof(made))
		return false;
	snprintf(made, sizeof(made), "%s ", word);
	return put(h, h->from, 0, made);
}

/* PT=>T#5s: => is for what a block gives. */
static bool turn_arrow(struct habits *h)
{
	for (int i = 2; i + 1 < h->count; i++)
		if (is(h, i, "=>") && block_word(h, 0) && (ascii_digit(*text_of(h, i + 1)) || ascii_same(text_of(h, i + 1), "T#", 2)))
			return put(h, h->piece[i].at, 2, ":=");
	return false;
}

/* ---- operands ---- */

/* I 0.0 → %IX0.0, with a blank as Siemens prints it; E and A are the German ones. */
static bool join_address(struct habits *h)
{
	static const char from[] = "IEQAM", to[] = "IIQQM";
	char made[32];

	for (int i = 1; i + 1 < h->count; i++) {
		const char *letter = h->piece[i].len == 1 ? strchr(from, ascii_upper(*text_of(h, i))) : NULL;
		const char *text = text_of(h, i + 1);
		struct iec_addr addr;

		if (!letter || !ascii_digit(*text) || !memchr(text, '.', h->piece[i + 1].len) || h->piece[i + 1].len > 12)
			continue;
		snprintf(made, sizeof(made), "%%%cX%.*s", to[letter - from], (int)h->piece[i + 1].len, text);
		if (iec_addr_parse(made, strlen(made), &addr) == ADDR_OK)
			return put(h, h->piece[i].at, end_of(h, i + 1) - h->piece[i].at, made);
	}
	return false;
}

/* Omron: 0.00 → %IX0.0, and 10.00 or 100.00, the first output → %QX0.0; a word has 16 bits. */
static bool address_of_omron(struct habits *h)
{
	char made[32];
	struct iec_addr addr;

	for (int i = 1; i < h->count; i++) {
		const char *text = text_of(h, i);
		const size_t len = h->piece[i].len, digits = strspn(text, "0123456789");
		const unsigned long word = number_at(text), bit = len == digits + 3 ? number_at(text + digits + 1) : 16;
		const unsigned long first = word >= 100 ? 100 : word >= 10 ? 10 : 0;

		if (!digits || digits > 3 || text[digits] != '.' || strspn(text + digits + 1, "0123456789") != 2 || bit > 15 ||
		    (!is_one_of(h, i - 1, elements, COUNT(elements)) && !is(h, i - 1, "P") && !is(h, i - 1, "N")))
			continue;
		snprintf(made, sizeof(made), "%%%cX%lu.%lu", first ? 'Q' : 'I', 2 * (word - first) + bit / 8, bit % 8);
		if (iec_addr_parse(made, strlen(made), &addr) == ADDR_OK)
			return put(h, h->piece[i].at, len, made);
	}
	return false;
}

/* TIM 000 #50 → TON T0 PT:=T#5s, CNT 1 #10 → CTU C1 PV:=10: Omron's timers count tenths of a second. */
static bool timer_of_omron(struct habits *h)
{
	static const struct block timer = { "TIM", "TON", "PT" }, counter = { "CNT", "CTU", "PV" };
	const struct block *block = is(h, 0, "TIM") ? &timer : is(h, 0, "CNT") ? &counter : NULL;
	const char *number = h->count == 3 ? text_of(h, 1) : "", *value = h->count == 3 ? text_of(h, 2) : "";
	char preset[32], made[MADE];

	number += ascii_upper(*number) == *block_letter(block);
	value += *value == '#' || *value == '&' || ascii_upper(*value) == 'K';
	if (!block || !ascii_digit(*number) || !ascii_digit(*value))
		return false;
	print_preset(block, number_at(value), 100, preset, sizeof(preset));
	snprintf(made, sizeof(made), "%s %s%lu %s", block->ours, block_letter(block), number_at(number), preset);
	return put(h, h->from, h->to - h->from, made);
}

/* #Start, <Start>, [Start], {Start}: a name has nothing around it. */
static bool bare_name(struct habits *h)
{
	static const char *const open = "<[{", *const close = ">]}";

	for (int i = 1; i < h->count; i++) {
		const char *text = text_of(h, i), *sign = strchr(open, *text);
		const size_t len = h->piece[i].len;

		if (*text == '#' && len > 1 && mend_is_word(text[1]))
			return put(h, h->piece[i].at, 1, "");
		if (sign && len > 2 && text[len - 1] == close[sign - open] && mend_is_word(text[1]) &&
		    is_one_of(h, i - 1, elements, COUNT(elements)))
			return unwrap(h, h->piece[i].at, len);
	}
	return false;
}

/* NO ~Start → NC Start. */
static bool turn_tilde(struct habits *h)
{
	char made[MADE];

	if (h->count != 2 || *text_of(h, 1) != '~' || (!is(h, 0, "NO") && !is(h, 0, "NC")))
		return false;
	snprintf(made, sizeof(made), "%s %.*s", is(h, 0, "NO") ? "NC" : "NO", (int)h->piece[1].len - 1, text_of(h, 1) + 1);
	return put(h, h->from, h->to - h->from, made);
}

/* Number @n of a name such as T4:0 or Local:1:I.Data.3; its end. */
static const char *take_count(const char *text, unsigned *n)
{
	*n = (unsigned)number_at(text);
	return text + strspn(text, "0123456789");
}

/* T4:0/DN → T4_0.Q, C5:1.ACC → C5_1.CV. @out: 64 bytes. */
static bool timer_of_logix(const char *text, size_t len, char *out)
{
	static const struct { const char *theirs, *timer, *counter; } parts[] = {
		{ "DN", "Q", "Q" }, { "EN", "IN", "CU" }, { "ACC", "ET", "CV" }, { "PRE", "PT", "PV" }, { "CU", NULL, "CU" },
	};
	const bool timer = ascii_upper(*text) == 'T';
	unsigned file, number;
	const char *at;

	if ((!timer && ascii_upper(*text) != 'C') || !ascii_digit(text[1]))
		return false;
	at = take_count(text + 1, &file);
	if (*at != ':' || !ascii_digit(at[1]))
		return false;
	at = take_count(at + 1, &number);
	for (size_t i = 0; (*at == '/' || *at == '.') && i < COUNT(parts); i++) {
		const char *ours = timer ? parts[i].timer : parts[i].counter;

		if (!ours || !ascii_is(parts[i].theirs, at + 1, len - (size_t)(at + 1 - text)))
			continue;
		snprintf(out, 64, "%c%u_%u.%s", timer ? 'T' : 'C', file, number, ours);
		return true;
	}
	return false;
}

/* Local:1:I.Data.3 → %IX2.3, as I:1/3 is: a slot has two bytes. */
static bool slot_of_logix(const char *text, size_t len, char *out)
{
	const char *at = text + 6;
	unsigned slot, bit;
	char area;

	if (len < 16 || !ascii_same(text, "Local:", 6) || !ascii_digit(*at))
		return false;
	at = take_count(at, &slot);
	area = *at == ':' ? ascii_upper(at[1]) : 0;
	if ((area != 'I' && area != 'O') || !ascii_same(at + 2, ".Data.", 6) || !ascii_digit(at[8]))
		return false;
	at = take_count(at + 8, &bit);
	if (at != text + len || slot > 100 || bit > 31)
		return false;
	snprintf(out, 64, "%%%cX%u.%u", area == 'I' ? 'I' : 'Q', 2 * slot + bit / 8, bit % 8);
	return true;
}

/* N7:3 → %MW6. */
static bool word_of_logix(const char *text, size_t len, char *out)
{
	unsigned word;

	if (len < 4 || !ascii_same(text, "N7:", 3) || strspn(text + 3, "0123456789") < len - 3)
		return false;
	take_count(text + 3, &word);
	snprintf(out, 64, "%%MW%u", 2 * word);
	return word < 4000;
}

static bool name_of_logix(struct habits *h)
{
	char made[64];

	for (int i = 0; i < h->count; i++) {
		const char *text = text_of(h, i);
		const size_t len = h->piece[i].len;

		if (memchr(text, ':', len) && (timer_of_logix(text, len, made) || slot_of_logix(text, len, made) ||
					       word_of_logix(text, len, made)))
			return put(h, h->piece[i].at, len, made);
	}
	return false;
}

/* ---- words of other languages ---- */

/* = Lamp, U Start, UN Start: Siemens' list; S Lamp 1: its box. COIL SET Lamp: a word too many. */
static bool word_of_siemens(struct habits *h)
{
	static const char *const words[][2] = {
		{ "=", "COIL" }, { "U", "NO" }, { "UN", "NC" }, { "A", "NO" }, { "AN", "NC" },
	};
	static const char *const kinds[] = { "S", "SET", "R", "RST", "RESET" };

	if (h->count == 3 && is(h, 0, "COIL") && is_operand(h, 2) && is_one_of(h, 1, kinds, COUNT(kinds)))
		return put(h, h->from, end_of(h, 1) - h->from, ascii_upper(*text_of(h, 1)) == 'S' ? "S" : "R");
	if (h->count == 3 && is(h, 2, "1") && (is(h, 0, "S") || is(h, 0, "R") || is(h, 0, "SET") || is(h, 0, "RST")))
		return put(h, end_of(h, 1), h->to - end_of(h, 1), "");
	if (h->count == 2 && is(h, 0, "RES") && is_operand(h, 1) && !block_of(h, 1))
		return put(h, h->from, h->piece[0].len, "R");
	for (size_t i = 0; h->count == 2 && is_operand(h, 1) && i < COUNT(words); i++)
		if (is(h, 0, words[i][0]))
			return put(h, h->from, h->piece[0].len, words[i][1]);
	return false;
}

/* JMP End:, CALL Alarm(), GOSUB Alarm. */
static bool word_of_basic(struct habits *h)
{
	if (h->count == 2 && is(h, 0, "JMP") && h->text[h->to - 1] == ':')
		return put(h, h->to - 1, 1, "");
	if (h->count == 4 && is(h, 0, "CALL") && is(h, 2, "(") && is(h, 3, ")"))
		return put(h, h->piece[2].at, h->to - h->piece[2].at, "");
	return h->count == 2 && is(h, 0, "GOSUB") && put(h, h->from, h->piece[0].len, "CALL");
}

/* -(Lamp)-, --(S)-- Lamp: what is left is looked at by mend.c. */
static bool bare_coil(struct habits *h)
{
	const size_t dashes = strspn(h->text + h->from, "-");
	const char *close = memchr(h->text + h->from, ')', h->to - h->from);
	size_t behind, len;

	if (!close || h->text[h->from + dashes] != '(' || h->from + dashes >= h->to)
		return false;
	behind = (size_t)(close - h->text) + 1;
	len = strspn(h->text + behind, "-");
	if (!dashes && !len)
		return false;
	if (dashes && !put(h, h->from, dashes, ""))
		return false;
	return !len || put(h, behind - dashes, len, "");
}

/* IF Start THEN → [ Start ] */
static bool if_then(struct habits *h)
{
	char made[MADE];

	if (h->count < 3 || !is(h, 0, "IF") || !is(h, h->count - 1, "THEN"))
		return false;
	snprintf(made, sizeof(made), "[ %.*s ]", (int)(end_of(h, h->count - 2) - h->piece[1].at), text_of(h, 1));
	return put(h, h->from, h->to - h->from, made);
}

/* Words that compute: CPT Sum A+B, CLR A, INC A, DEC A, A++, LIM 1 A 5. */
static bool compute(struct habits *h)
{
	const bool open = is(h, 1, "(") && is(h, h->count - 1, ")");
	const int name = 1 + open, last = h->count - 1 - open;
	const int value = name + 1 + is(h, name + 1, ",");
	char made[MADE] = "";

	if (h->count == 1 && is_operand(h, 0) && h->piece[0].len > 2 && h->to - h->from < MADE / 3 &&
	    !strncmp(h->text + h->to - 2, "++", 2)) {
		snprintf(made, sizeof(made), "[ %.*s := %.*s + 1 ]", (int)h->piece[0].len - 2, text_of(h, 0),
			 (int)h->piece[0].len - 2, text_of(h, 0));
	} else if (name > last || !is_operand(h, name) || h->to - h->from > MADE / 3) {
		if (!is(h, 0, "LIM") && !is(h, 0, "LIMIT"))
			return false;
	} else if (is(h, 0, "CPT") && value <= last) {
		snprintf(made, sizeof(made), "[ %.*s := %.*s ]", (int)h->piece[name].len, text_of(h, name),
			 (int)(end_of(h, last) - h->piece[value].at), text_of(h, value));
	} else if (is(h, 0, "CLR") && name == last) {
		snprintf(made, sizeof(made), "[ %.*s := 0 ]", (int)h->piece[name].len, text_of(h, name));
	} else if ((is(h, 0, "INC") || is(h, 0, "DEC")) && name == last) {
		snprintf(made, sizeof(made), "[ %.*s := %.*s %c 1 ]", (int)h->piece[name].len, text_of(h, name),
			 (int)h->piece[name].len, text_of(h, name), is(h, 0, "INC") ? '+' : '-');
	}
	if (is(h, 0, "LIM") && h->to - h->from < MADE / 3) { /* low limit, test, high limit */
		const bool comma = is(h, name + 1, ",");
		const int test = name + 1 + comma, high = test + 1 + comma;

		if (high == last && is_operand(h, test))
			snprintf(made, sizeof(made), "[ %.*s >= %.*s AND %.*s <= %.*s ]", (int)h->piece[test].len,
				 text_of(h, test), (int)h->piece[name].len, text_of(h, name), (int)h->piece[test].len,
				 text_of(h, test), (int)h->piece[high].len, text_of(h, high));
	}
	return *made && put(h, h->from, h->to - h->from, made);
}

/* ---- brackets ---- */

static bool has_sign(const struct habits *h)
{
	bool has = false;

	for (size_t at = h->from; at < h->to && !has; at++)
		has = strchr("<>=", h->text[at]);
	return has;
}

/* [ A > 5 and A > 5 ]: the other bracket; ( A > 5 ): the right ones. */
static bool close_brackets(struct habits *h)
{
	const bool open = h->text[h->from] == '[', close = h->to > h->from && h->text[h->to - 1] == ']';

	if (h->to - h->from < 4)
		return false;
	if (open && !memchr(h->text + h->from, ']', h->to - h->from))
		return put(h, h->to, 0, " ]");
	if (close && !memchr(h->text + h->from, '[', h->to - h->from) && has_sign(h))
		return put(h, h->from, 0, "[ ");
	if (h->text[h->from] != '(' || h->text[h->to - 1] != ')' || !has_sign(h) ||
	    memchr(h->text + h->from + 1, '(', h->to - h->from - 1))
		return false;
	return put(h, h->from, 1, "[") && put(h, h->to - 1, 1, "]");
}

/* [ (A > B ] → [ (A > B) ], [ A > B) ] → [ A > B ] */
static bool balance(struct habits *h)
{
	size_t surplus = 0;
	int depth = 0;

	for (size_t at = h->from; at < h->to; at++) {
		depth += h->text[at] == '(' ? 1 : h->text[at] == ')' ? -1 : 0;
		if (depth < 0 && !surplus)
			surplus = at;
	}
	if (surplus)
		return put(h, surplus, 1, "");
	if (depth <= 0 || depth > 3 || h->text[h->to - 1] != ']')
		return false;
	for (surplus = h->to - 1; surplus > h->from && h->text[surplus - 1] == ' '; surplus--)
		;
	return put(h, surplus, 0, depth == 1 ? ")" : depth == 2 ? "))" : ")))");
}

/* Does nothing but the closing bracket follow? */
static bool past_sign(const struct habits *h, size_t at)
{
	return h->text[at + strspn(h->text + at, " ")] == ']';
}

/* [ A := A++ ] → [ A := A + 1 ] */
static bool count_up(struct habits *h)
{
	char sign;

	for (size_t at = h->from; at + 1 < h->to; at++) {
		sign = h->text[at];
		if ((sign == '+' || sign == '-') && h->text[at + 1] == sign && past_sign(h, at + 2) &&
		    memchr(h->text + h->from, '=', at - h->from))
			return put(h, at, 2, sign == '+' ? " + 1" : " - 1");
	}
	return false;
}

/* In brackets: 50% → 50, A BETWEEN 1 AND 5 → A >= 1 AND A <= 5, and a cell for each of two statements. */
static bool mend_inside(struct habits *h)
{
	char made[MADE];

	if (h->text[h->from] != '[')
		return false;
	if (balance(h) || count_up(h))
		return true;
	for (int i = 1; i < h->count; i++) {
		const size_t len = h->piece[i].len;

		if (len > 1 && text_of(h, i)[len - 1] == '%' && ascii_digit(*text_of(h, i)))
			return put(h, end_of(h, i) - 1, 1, "");
		if (is(h, i, "%") && is_number(h, i - 1))
			return put(h, end_of(h, i - 1), end_of(h, i) - end_of(h, i - 1), "");
		if (is(h, i, ";") && i + 3 < h->count && is(h, i + 2, ":="))
			return put(h, h->piece[i].at, 1, " ] | [");
		if (is(h, i, "BETWEEN") && i + 3 < h->count && is(h, i + 2, "AND")) {
			snprintf(made, sizeof(made), "%.*s >= %.*s AND %.*s <= %.*s", (int)h->piece[i - 1].len, text_of(h, i - 1),
				 (int)h->piece[i + 1].len, text_of(h, i + 1), (int)h->piece[i - 1].len, text_of(h, i - 1),
				 (int)h->piece[i + 3].len, text_of(h, i + 3));
			return put(h, h->piece[i - 1].at, end_of(h, i + 3) - h->piece[i - 1].at, made);
		}
	}
	return false;
}

/* ; on: a comment at the end of the row. */
static bool name_comment(struct habits *h)
{
	const bool last = !h->text[h->to + strspn(h->text + h->to, " ")];

	return last && h->from && h->count > 1 && (is(h, 0, ";") || is(h, 0, "#")) && put(h, h->from, 1, "//");
}

/* A // in the middle: the comment ends at the next bar. */
static void close_comment(struct habits *h)
{
	char made[MADE];
	size_t at = 0, end, last, first;

	while (h->text[at] && !(h->text[at] == '/' && h->text[at + 1] == '/'))
		at = skip(h->text, at) != at ? skip(h->text, at) : at + 1;
	for (last = at; last && h->text[last - 1] == ' '; last--)
		;
	if (!h->text[at] || !last || h->text[last - 1] == '|')
		return;
	end = at + strcspn(h->text + at, "|");
	last = end;
	first = at + 2 + strspn(h->text + at + 2, " ");
	while (last > first && h->text[last - 1] == ' ')
		last--;
	if (last <= first || last - first + 10 >= sizeof(made) || strstr(h->text + at, "*)"))
		return;
	snprintf(made, sizeof(made), "(* %.*s *) %s", (int)(last - first), h->text + first, h->text[end] ? "" : "|");
	if (!put(h, at, end - at, made) || h->out->column != (int)at + 1)
		return;
	snprintf(h->out->from, sizeof(h->out->from), "//");
	snprintf(h->out->to, sizeof(h->out->to), "(* *)");
}

/* ---- all of them ---- */

bool mend_habits(struct project *project, char *text, size_t size, struct mended *out)
{
	static bool (*const habits[])(struct habits *) = {
		join_logix, join_branches, fill_pin, join_pins, part_elements, bar_of_other, compare_word, name_first, edge_of_power,
		edge_of_logix, name_of_logix, join_address, address_of_omron, timer_of_omron, bare_name, turn_tilde, name_comment,
		name_constant, draw_wire, name_block, preset_of_logix, take_constant, take_time, bare_values, call_block, turn_name,
		drop_sign, add_word, turn_arrow, word_of_siemens, word_of_basic, bare_coil, if_then, compute, close_brackets, mend_inside,
	};
	struct habits h = { .project = project, .out = out, .text = text, .size = size };
	int again = 0;

	close_comment(&h);
	for (int n = 0; !h.full && cell_open(&h, n); again = 0, n++)
		for (size_t i = 0; i < COUNT(habits) && again < AGAIN && !h.full; i++)
			if (h.count && habits[i](&h)) {
				again++;
				cell_open(&h, n);
				i = (size_t)-1;
			}
	return h.changed && !h.full;
}
