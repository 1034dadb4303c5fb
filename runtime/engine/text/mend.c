/* SPDX-License-Identifier: MIT
 *
 * mend - tables of what people write in other tools, and a few rules about missing parts.
 *
 * Words and signs are replaced by rows of `rules`, then the steps of a kind of line run in
 * order until the line reads. It never changes the project.
 */
#include "engine/text/mend.h"
#include "engine/text/mend_drawn.h"
#include "engine/text/mend_habits.h"
#include "engine/text/mend_number.h"
#include "engine/text/mend_steps.h"

#include "engine/base/ascii.h"
#include "engine/model/dialect.h"
#include "engine/base/literal.h"
#include "engine/model/expr_args.h"
#include "engine/text/reader.h"
#include "engine/text/text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Where a row of `rules` holds. */
enum {
	IN_CELL = 1 << 0,   /* the first word of a cell                       */
	IN_ROW = 1 << 1,    /* behind it                                      */
	IN_EXPR = 1 << 2,   /* in [ … ] of a cell                             */
	IN_NAME = 1 << 3,   /* a declaration before its colon                 */
	IN_TYPE = 1 << 4,   /* behind the colon                               */
	IN_VALUE = 1 << 5,  /* behind the :=                                  */
	IN_OPER = 1 << 6,   /* the first word of an instruction               */
	IN_LIST = 1 << 7,   /* behind it                                      */
	IN_FIRST = 1 << 8,  /* the first word of any other line               */
	IN_HEAD = 1 << 9,   /* behind it                                      */
	ROWS = IN_CELL | IN_ROW | IN_EXPR,
	VARS = IN_NAME | IN_TYPE | IN_VALUE,
	LISTS = IN_OPER | IN_LIST,
	ANY = ROWS | VARS | LISTS | IN_FIRST | IN_HEAD,
};

/* What a message calls a blank; pot.sh looks for it. */
static const char blank[] = "a blank";

/* The first row that fits counts. A row whose texts are the same protects a sign from the
 * rows below it. */
static const struct rule {
	const char *from, *to;
	uint16_t where;
} rules[] = {
	/* signs that look like others, or like nothing */
	{ "\u00a0", " ", ANY }, { "\u2007", " ", ANY }, { "\u202f", " ", ANY },
	{ "\u3000", " ", ANY }, { "\u200b", "", ANY }, { "\u200c", "", ANY },
	{ "\u200d", "", ANY }, { "\u2060", "", ANY }, { "\ufeff", "", ANY },
	{ "\u2502", "|", ROWS | IN_FIRST }, { "\u2503", "|", ROWS | IN_FIRST },
	{ "\u2551", "|", ROWS | IN_FIRST }, { "\u00a6", "|", ROWS | IN_FIRST },
	{ "\uff5c", "|", ROWS | IN_FIRST }, { "\u251c", "|", ROWS }, { "\u2524", "|", ROWS },
	{ "\u2500\u2500\u2500", "---", ROWS }, { "\u2500\u2500", "---", ROWS },
	{ "\u2500", "---", ROWS }, { "\u2014", "---", IN_CELL }, { "\u2013", "-", ANY },
	{ "\u2212", "-", ANY },
	{ "\u201c", "\"", ANY }, { "\u201d", "\"", ANY }, { "\u201e", "\"", ANY },
	{ "\u00ab", "\"", ANY }, { "\u00bb", "\"", ANY },
	{ "\u2018", "'", ANY }, { "\u2019", "'", ANY }, { "\u201a", "'", ANY },
	{ "`", "'", IN_EXPR | IN_VALUE },
	{ "\uff1a", ":", ANY }, { "\uff1b", ";", ANY }, { "\uff0c", ",", ANY },
	{ "\uff08", "(", ANY }, { "\uff09", ")", ANY }, { "\uff1d", "=", ANY },
	/* operators */
	{ "+=", "+=", IN_EXPR }, { "-=", "-=", IN_EXPR }, { "++", "++", IN_EXPR },
	{ "===", "=", IN_EXPR }, { "==", "=", IN_EXPR },
	{ "!=", "<>", IN_EXPR }, { "/=", "<>", IN_EXPR }, { "><", "<>", IN_EXPR },
	{ "=<", "<=", IN_EXPR }, { "=>", ">=", IN_EXPR }, { "\u2264", "<=", IN_EXPR },
	{ "\u2265", ">=", IN_EXPR }, { "\u2260", "<>", IN_EXPR },
	{ "\u00d7", "*", IN_EXPR }, { "\u00f7", "/", IN_EXPR },
	{ "&&", "AND", IN_EXPR }, { "||", "OR", IN_EXPR }, { "!", "NOT ", IN_EXPR },
	{ "~", "NOT ", IN_EXPR }, { "%%", "MOD", IN_EXPR }, { "% ", "MOD ", IN_EXPR },
	{ "DIV", "/", IN_EXPR },
	{ ":=", ":=", ANY }, { "<=", "<=", ANY }, { ">=", ">=", ANY },
	{ "->", "=>", IN_ROW | LISTS }, { "=>", "=>", ANY },
	{ "==", ":=", IN_ROW | VARS | IN_LIST }, { "=:", ":=", ANY },
	{ "=", ":=", IN_ROW | VARS | IN_LIST },
	{ ";", "", ROWS | IN_LIST | IN_HEAD },
	/* words of cells */
	{ "XIC", "NO", IN_CELL }, { "XIO", "NC", IN_CELL }, { "OTE", "COIL", IN_CELL },
	{ "OTL", "S", IN_CELL }, { "OTU", "R", IN_CELL }, { "SET", "S", IN_CELL },
	{ "RESET", "R", IN_CELL }, { "RST", "R", IN_CELL }, { "LATCH", "S", IN_CELL },
	{ "UNLATCH", "R", IN_CELL }, { "OUT", "COIL", IN_CELL },
	{ "OUTPUT", "COIL", IN_CELL }, { "CONTACT", "NO", IN_CELL },
	{ "LD", "NO", IN_CELL }, { "LDI", "NC", IN_CELL }, { "LDN", "NC", IN_CELL }, { "ANI", "NC", IN_CELL },
	{ "RISING", "P", IN_CELL }, { "FALLING", "N", IN_CELL }, { "PULSE", "COILP", IN_CELL },
	{ "PLS", "COILP", IN_CELL }, { "PLF", "COILN", IN_CELL },
	{ "ONS", "P", IN_CELL }, { "OSR", "P", IN_CELL }, { "OSF", "N", IN_CELL },
	{ "TIMER", "TON", IN_CELL }, { "TMR", "TON", IN_CELL }, { "RTO", "TONR", IN_CELL },
	{ "COUNTER", "CTU", IN_CELL }, { "CTR", "CTU", IN_CELL },
	{ "GOTO", "JMP", IN_CELL }, { "JUMP", "JMP", IN_CELL },
	{ "INV", "NOT", IN_CELL }, { "RETURN", "RET", IN_CELL }, { "JSR", "CALL", IN_CELL },
	{ "MOV", "MOVE", IN_CELL }, { "COPY", "MOVE", IN_CELL }, { "EQU", "EQ", IN_CELL },
	{ "NEQ", "NE", IN_CELL }, { "GRT", "GT", IN_CELL }, { "GEQ", "GE", IN_CELL },
	{ "LES", "LT", IN_CELL }, { "LEQ", "LE", IN_CELL },
	{ "( S )", "S ", IN_CELL }, { "(S)", "S ", IN_CELL }, { "(R)", "R ", IN_CELL },
	{ "(/)", "COILNOT ", IN_CELL }, { "( )", "COIL ", IN_CELL }, { "()", "COIL ", IN_CELL },
	{ "!", "NC ", IN_CELL }, { "/", "NC ", IN_CELL },
	/* types and values */
	{ "BOOLEAN", "BOOL", IN_TYPE }, { "BIT", "BOOL", IN_TYPE }, { "FLAG", "BOOL", IN_TYPE },
	{ "INTEGER", "INT", IN_TYPE }, { "SHORT", "INT", IN_TYPE }, { "LONG", "DINT", IN_TYPE },
	{ "INT8", "SINT", IN_TYPE }, { "INT16", "INT", IN_TYPE }, { "INT32", "DINT", IN_TYPE },
	{ "INT64", "LINT", IN_TYPE }, { "UINT8", "USINT", IN_TYPE },
	{ "UINT16", "UINT", IN_TYPE }, { "UINT32", "UDINT", IN_TYPE },
	{ "FLOAT", "REAL", IN_TYPE }, { "SINGLE", "REAL", IN_TYPE },
	{ "DOUBLE", "LREAL", IN_TYPE }, { "TEXT", "STRING", IN_TYPE },
	{ "CHAR", "STRING[1]", IN_TYPE }, { "TIMER", "TON", IN_TYPE },
	{ "COUNTER", "CTU", IN_TYPE },
	{ "ON", "TRUE", IN_VALUE }, { "OFF", "FALSE", IN_VALUE },
	{ "YES", "TRUE", IN_VALUE }, { "NO", "FALSE", IN_VALUE },
	/* instructions */
	{ "LDI", "LDN", IN_OPER }, { "ANI", "ANDN", IN_OPER }, { "ORI", "ORN", IN_OPER },
	{ "AN", "ANDN", IN_OPER }, { "ON", "ORN", IN_OPER }, { "A", "AND", IN_OPER },
	{ "U", "AND", IN_OPER }, { "UN", "ANDN", IN_OPER }, { "O", "OR", IN_OPER },
	{ "OUT", "ST", IN_OPER }, { "=", "ST", IN_OPER }, { "SET", "S", IN_OPER },
	{ "RST", "R", IN_OPER }, { "RESET", "R", IN_OPER }, { "CALL", "CAL", IN_OPER },
	{ "GOTO", "JMP", IN_OPER }, { "JC", "JMPC", IN_OPER }, { "JCN", "JMPCN", IN_OPER },
	{ "END", "RET", IN_OPER }, { "MOV", "MOVE", IN_OPER },
	/* lines that begin or end something */
	{ "#", "//", IN_FIRST | IN_NAME | IN_OPER }, { "--", "//", IN_FIRST | IN_NAME | IN_OPER },
	{ "PROG", "PROGRAM", IN_FIRST }, { "NETWORK", "RUNG", IN_FIRST },
	{ "NET", "RUNG", IN_FIRST }, { "END PROGRAM", "END_PROGRAM", IN_FIRST | IN_OPER },
	{ "ENDPROGRAM", "END_PROGRAM", IN_FIRST | IN_OPER },
	{ "END_PROG", "END_PROGRAM", IN_FIRST | IN_OPER },
	{ "END_RUNG", "", IN_FIRST }, { "END", "END_PROGRAM", IN_FIRST },
	{ "END VAR", "END_VAR", IN_FIRST | IN_NAME }, { "ENDVAR", "END_VAR", IN_FIRST | IN_NAME },
	{ "END_VARS", "END_VAR", IN_FIRST | IN_NAME }, { "VARS", "VAR", IN_FIRST },
	{ "VAR GLOBAL", "VAR_GLOBAL", IN_FIRST }, { "VAR INPUT", "VAR_INPUT", IN_FIRST },
	{ "VAR OUTPUT", "VAR_OUTPUT", IN_FIRST }, { "VARIABLES", "VAR", IN_FIRST },
	{ "FUNCTION BLOCK", "FUNCTION_BLOCK", IN_FIRST },
	{ "LADDER", "LD", IN_HEAD }, { "LAD", "LD", IN_HEAD }, { "CONST", "CONSTANT", IN_HEAD },
	{ "AWL", "IL", IN_HEAD }, { "KOP", "LD", IN_HEAD },
};

#define COUNT(table) (sizeof(table) / sizeof((table)[0]))

/* Longer than any line. */
#define MADE 200
#define MOST 160 /* bytes of a line                                              */

struct mender {
	const struct mend_line *in;
	struct mended *out;
	char text[MOST];
	size_t len;
	uint16_t where; /* of the cursor                                      */
	int depth;      /* of [ in a row, of [ and ( elsewhere                */
	bool changed, full;
};

/* ---- changes ---- */

/* A character that cannot be seen is shown by its number. */
static void show(char *out, size_t size, const char *text, size_t len)
{
	const unsigned char *byte = (const unsigned char *)text;

	if (len == 2 && byte[0] == 0xc2 && byte[1] == 0xa0)
		snprintf(out, size, "U+00A0");
	else if (len == 3 && (byte[0] == 0xe2 || byte[0] == 0xef || byte[0] == 0xe3) &&
		 (utf8_width(text, len) != 1 || utf8_code(text, len) == 0x2007 ||
		  utf8_code(text, len) == 0x202f))
		snprintf(out, size, "U+%04X", (unsigned int)utf8_code(text, len));
	else
		snprintf(out, size, "%.*s", (int)(len && text[len - 1] == ' ' ? len - 1 : len),
			 text);
}

/* The new text of the first change, without blanks around it. */
static void show_new(struct mender *m, const char *to)
{
	size_t len = strlen(to);

	while (len > 1 && to[len - 1] == ' ')
		len--;
	while (len > 1 && *to == ' ')
		to++, len--;
	snprintf(m->out->to, sizeof(m->out->to), "%.*s", (int)len, to);
	if (strcmp(m->out->to, " ") == 0)
		snprintf(m->out->to, sizeof(m->out->to), "%s", blank);
}

/* Puts @to in the place of @len bytes at @at. m->out gets the first change, for the message. */
static void change(struct mender *m, size_t at, size_t len, const char *to)
{
	const size_t add = strlen(to);

	if (at > m->len || len > m->len - at || m->len - len + add >= sizeof(m->text)) {
		m->full = true;
		return;
	}
	if (!m->changed) {
		m->out->column = (int)at + 1;
		show(m->out->from, sizeof(m->out->from), m->text + at, len);
		show_new(m, to);
		m->out->id = !len ? DIAG_MISSING : !*to ? DIAG_SURPLUS :
						    DIAG_WRITE_INSTEAD;
	}
	m->changed = true;
	memmove(m->text + at + add, m->text + at + len, m->len - at - len);
	memcpy(m->text + at, to, add);
	m->len += add - len;
	m->text[m->len] = '\0';
}

/* ---- words and signs ---- */

/* Is the word at @at one that may stand here? */
static bool is_known(const struct mender *m, size_t at)
{
	const char *text = m->text + at;
	const size_t len = mend_word_length(text);
	struct word_table *words = &m->in->project->words;

	if (m->where & (IN_CELL | IN_TYPE))
		return words_find(words, text, len) != WORD_COUNT ||
		       (m->where & IN_TYPE && iec_type_find(text, len) != IEC_NONE);
	return m->where & IN_OPER && op_find(text, len) != OP_COUNT;
}

static const struct rule *rule_at(const struct mender *m, size_t at)
{
	const char *text = m->text + at;

	for (size_t i = 0; i < COUNT(rules); i++) {
		const struct rule *rule = &rules[i];
		const size_t len = strlen(rule->from);
		const bool word = mend_is_word(rule->from[0]) && (unsigned char)rule->from[0] < 0x80;

		if (!(rule->where & m->where) || m->len - at < len ||
		    !ascii_same(rule->from, text, len))
			continue;
		if (at && strcmp(rule->to, "//") == 0)
			continue;
		if (word && ((at && mend_is_word(text[-1])) || mend_is_word(text[len]) ||
			     is_known(m, at)))
			continue;
		return rule;
	}
	return NULL;
}

/* Sets `where` after the cursor has passed the token @text. */
static void pass(struct mender *m, const char *text, size_t len)
{
	const bool assign = len == 2 && text[0] == ':' && text[1] == '=';

	switch (m->in->kind) {
	case MEND_ROW:
		m->depth += *text == '[' ? 1 : *text == ']' && m->depth ? -1 : 0;
		m->where = m->depth ? IN_EXPR : *text == '|' ? IN_CELL : IN_ROW;
		break;
	case MEND_VAR:
		if (assign)
			m->where = IN_VALUE;
		else if (*text == ':')
			m->where = IN_TYPE;
		break;
	case MEND_LIST:
		m->where = IN_LIST;
		break;
	case MEND_HEAD:
		m->where = m->where & IN_EXPR ? IN_EXPR : IN_HEAD;
		break;
	}
}

static bool separates(const struct mender *m, size_t comma)
{
	return mend_separates(m->text, comma, m->in->kind == MEND_VAR);
}

/* 1.500,5, but not in [1,500,5]. */
static size_t take_groups(const struct mender *m, size_t at, char made[MADE])
{
	const size_t len = mend_groups(m->text, at, made, MADE);

	for (size_t i = at; i < at + len; i++)
		if ((m->text[i] == ',' || m->text[i] == ' ') && separates(m, i))
			return 0;
	return len;
}

/* A number in the manner of C, of assemblers, or with a comma; a time without T#. Returns the
 * place behind it. */
static size_t take_number(struct mender *m, size_t at)
{
	const char *text = m->text + at;
	const bool holds = m->where & (IN_EXPR | IN_ROW | IN_VALUE | IN_LIST);
	size_t len = 0, whole;
	char made[MADE];

	if (text[0] == '0' && (text[1] == 'x' || text[1] == 'X' || text[1] == 'b') &&
	    mend_is_word(text[2])) {
		const char *base = text[1] == 'b' ? "2#" : "16#";

		change(m, at, 2, base);
		return at + strlen(base) + mend_word_length(m->text + at + strlen(base));
	}
	whole = holds ? take_groups(m, at, made) : 0;
	if (whole)
		change(m, at, whole, made);
	while (ascii_digit(text[len]) || (text[len] == '.' && ascii_digit(text[len + 1])) ||
	       (text[len] == '_' && ascii_digit(text[len + 1])))
		len++;
	if (text[len] == ',' && ascii_digit(text[len + 1]) && holds && m->depth < 2 &&
	    !separates(m, at + len)) {
		change(m, at + len, 1, ".");
		return take_number(m, at);
	}
	whole = mend_unit(m->text, at, len, made, sizeof(made));
	if (whole) {
		if (strlen(made) != whole || memcmp(made, text, whole) != 0)
			change(m, at, whole, made);
		return at + strlen(made);
	}
	return at + len + mend_word_length(text + len);
}

/* Behind a quoted text, which becomes one in single quotes. */
static size_t take_quoted(struct mender *m, size_t at)
{
	const char *close = strchr(m->text + at + 1, m->text[at]);
	size_t end = close ? (size_t)(close - m->text) : m->len;

	if (close && m->text[at] == '"' && m->in->kind != MEND_HEAD) {
		char made[MADE];

		snprintf(made, sizeof(made), "'%.*s'", (int)(end - at - 1), m->text + at + 1);
		change(m, at, end - at + 1, made);
	}
	return end < m->len ? end + 1 : m->len;
}

/* Behind a comment; @at if none begins there. */
static size_t skip_comment(const struct mender *m, size_t at)
{
	const char *text = m->text + at, *end;

	if (text[0] == '/' && text[1] == '/')
		return m->len;
	if (text[0] != '(' || text[1] != '*')
		return at;
	end = strstr(text, "*)");
	return end ? (size_t)(end - m->text) + 2 : m->len;
}

/* A step %X3.A has the name of its BOOL, if the program has one, else of its step. */
static bool take_step(const struct mender *m, const char *text, size_t len, struct dialect *found)
{
	struct names *names = &m->in->project->names;

	return names_find_any(names, found->name, strlen(found->name)) ||
	       dialect_find(text, len, 1, found);
}

/* %B3 → %MX0.3, I:1/3 → %IX2.3, %T0.D → T0.D. Returns the place behind it; @at: nothing is to be
 * changed. A plain name may be that of a variable. */
static size_t take_dialect(struct mender *m, size_t at)
{
	const char *text = m->text + at;
	size_t len = *text == '%';
	struct dialect_special special;
	struct dialect found;
	struct iec_addr addr;
	char made[MADE];
	bool first;

	if (!(m->where & (ROWS | IN_LIST | IN_NAME)) || (at && mend_is_word(text[-1])))
		return at;
	while (mend_is_word(text[len]) || (text[len] && strchr(".:/", text[len]) && mend_is_word(text[len + 1])))
		len++;
	if (memchr(text, ':', len) && dialect_special(text, len, &special) && *special.ours) {
		first = !m->changed;
		change(m, at, len, special.ours);
		if (first && m->changed)
			m->out->id = DIAG_SPECIAL_INSTEAD;
		pass(m, special.ours, strlen(special.ours));
		return at + strlen(special.ours);
	}
	if ((*text != '%' && !memchr(text, ':', len)) ||
	    iec_addr_parse(text, len, &addr) != ADDR_NONE || !dialect_find(text, len, 0, &found) ||
	    (found.kind == DIALECT_STEP && !take_step(m, text, len, &found)))
		return at;
	if (found.kind == DIALECT_ADDRESS)
		iec_addr_print(found.addr, made, sizeof(made));
	else
		snprintf(made, sizeof(made), "%s%s%s", found.name, *found.pin ? "." : "", found.pin);
	change(m, at, len, made);
	pass(m, made, strlen(made));
	return at + strlen(made);
}

/* 1FH → 16#1F. */
static void take_hex(struct mender *m, size_t at)
{
	const char *text = m->text + at;
	const size_t digits = strspn(text, "0123456789ABCDEFabcdef");
	char made[MADE];

	if (digits > 16 || ascii_upper(text[digits]) != 'H' || mend_is_word(text[digits + 1]) ||
	    !(m->where & (IN_EXPR | IN_VALUE | IN_ROW | IN_LIST)))
		return;
	snprintf(made, sizeof(made), "16#%.*s", (int)digits, text);
	change(m, at, digits + 1, made);
}

static size_t take_one(struct mender *m, size_t at)
{
	const struct rule *rule;
	const char *text = m->text + at;
	size_t len;

	if (skip_comment(m, at) != at)
		return skip_comment(m, at);
	len = take_dialect(m, at);
	if (len != at)
		return len;
	rule = rule_at(m, at);
	if (rule && strcmp(rule->from, rule->to) != 0) {
		len = strlen(rule->from);
		if (!*rule->to && m->where & (IN_CELL | IN_FIRST) && m->text[at + len] == ' ')
			len++;
		change(m, at, len, rule->to);
		/* Quotes and bars have more to be looked at. */
		if (!mend_is_word(*rule->to) || m->full)
			return m->full ? m->len : *rule->to == ' ' ? at + 1 :
			       *rule->to == '-' ? at + strlen(rule->to) : at;
		pass(m, rule->to, strlen(rule->to));
		return at + strlen(rule->to);
	}
	if (*text == '\'' || *text == '"') {
		pass(m, "'", 1);
		return take_quoted(m, at);
	}
	if (ascii_digit(*text)) {
		pass(m, "0", 1);
		take_hex(m, at);
		return take_number(m, at);
	}
	len = mend_word_length(text + (*text == '%')) + (*text == '%');
	if (*text == '%' && len > 1 && text[len] == ',' && ascii_digit(text[len + 1]) && m->where & (ROWS | LISTS))
		change(m, at + len, 1, "."); /* %I0,0 */
	len = mend_word_length(text);
	if (len && text[len] == '#')
		len++;
	if (!len)
		len = rule ? strlen(rule->from) : *text == '%' ? 1 + mend_word_length(text + 1) : 1;
	if (*text == '.' && len == 1)
		len += mend_word_length(text + 1);
	pass(m, text, len);
	return at + len;
}

/* Signs beyond ASCII first: they are part of no word. */
static void replace_signs(struct mender *m)
{
	static const uint16_t where[] = {
		[MEND_HEAD] = IN_FIRST | IN_HEAD, [MEND_ROW] = ROWS, [MEND_VAR] = VARS,
		[MEND_LIST] = LISTS,
	};
	const struct rule *rule;
	size_t at = 0;

	while (at < m->len && !m->full) {
		const char *close = m->text[at] == '"' || m->text[at] == '\'' ?
				    strchr(m->text + at + 1, m->text[at]) : NULL;

		m->where = where[m->in->kind];
		rule = (unsigned char)m->text[at] >= 0x80 ? rule_at(m, at) : NULL;
		if (rule)
			change(m, at, strlen(rule->from), rule->to);
		else if (close)
			at = (size_t)(close - m->text) + 1;
		else
			at = skip_comment(m, at) != at ? skip_comment(m, at) : at + 1;
	}
}

static void replace_words(struct mender *m)
{
	static const uint16_t start[] = {
		[MEND_HEAD] = IN_FIRST, [MEND_ROW] = IN_CELL, [MEND_VAR] = IN_NAME,
		[MEND_LIST] = IN_OPER,
	};
	size_t at = 0;

	m->where = start[m->in->kind];
	m->depth = 0;
	while (at < m->len && !m->full) {
		if (m->text[at] == ' ' || m->text[at] == '\t')
			at++;
		else
			at = take_one(m, at);
	}
}

/* ---- does it read? ---- */

static bool row_reads(const struct mender *m, struct diag_list *diags)
{
	static const char head[] = "RUNG\n| NO I0 |\n";
	char text[sizeof(head) + sizeof(m->text)];
	int len = snprintf(text, sizeof(text), "%s%s\n", head, m->text);
	struct rung *rung = text_read_rung(m->in->project, text, (size_t)len, diags);

	rung_free(rung);
	return rung;
}

static bool other_reads(const struct mender *m, struct diag_list *diags)
{
	struct reader *r = reader_new(m->in->project, "", diags);
	struct pou pou = { .language = LANGUAGE_IL, .il.arena = &m->in->project->arena };
	struct var var;
	char *copy;

	if (!r)
		return false;
	copy = reader_open(r, m->text, m->len);
	r->members = m->in->members;
	if (m->in->kind == MEND_LIST)
		read_il(r, &pou);
	else
		read_var(r, m->in->var_flags, &var);
	free(copy);
	reader_free(r);
	return true;
}

/* The first line of a step or a transition: its signs differ from those of other heads. */
static bool is_of_chart(const struct mender *m)
{
	const struct sfc_word *word;

	for (int i = 0; m->in->chart && (word = sfc_word(i)); i++) {
		const size_t len = strlen(word->word);

		if ((word->kind == SFC_WORD_STEP || word->kind == SFC_WORD_TRANSITION) &&
		    ascii_same(m->text, word->word, len) && m->text[len] == ' ')
			return true;
	}
	return false;
}

/* A head has no probe: its first word tells. */
static bool is_head(const struct mender *m)
{
	static const char *const words[] = {
		"//", "RUNG", "PROGRAM", "VAR", "END_", "FUNCTION", "RUNGBOARD", "PROJECT",
		"SUBROUTINE", "TYPE", "CONFIGURATION", "INCLUDE", "USES",
	};

	for (size_t i = 0; i < COUNT(words); i++)
		if (ascii_same(m->text, words[i], strlen(words[i])))
			return true;
	return is_of_chart(m);
}

/* Has the call that begins at @lex one argument too many, or too few? */
static bool is_wrong_call(const struct mender *m, struct lex lex, struct expr *expr,
			  struct diag_list *diags)
{
	struct word_table *words = &m->in->project->words;

	return expr_parse(&lex, expr, diags, (struct diag){ .id = DIAG_BAD_EXPRESSION }) &&
	       expr_has_wrong_call(expr, words);
}

/* Is the token at the cursor the end of a value? */
static bool ends_value(const struct lex *lex)
{
	static const char *const words[] = { "AND", "OR", "XOR", "NOT", "MOD" };

	for (size_t i = 0; i < COUNT(words); i++)
		if (lex_is(lex, words[i]))
			return false;
	return lex->token.kind == TOKEN_NAME || lex->token.kind == TOKEN_NUMBER || lex->token.kind == TOKEN_ADDRESS ||
	       lex_is(lex, ")") || lex_is(lex, "]");
}

/* Are its constants well formed, and do calls of built-in functions have the arguments that
 * they need? A reader leaves both to the checks that follow it. */
static bool numbers_read(const struct mender *m)
{
	struct expr *expr = malloc(sizeof(*expr));
	struct diag_list *diags = calloc(1, sizeof(*diags));
	bool good = expr && diags;
	struct literal literal;
	struct lex lex, ahead;
	bool value = false; /* a word behind one joins: A AND (B)               */

	lex_init(&lex, m->text, m->len);
	for (; good && lex_next(&lex) != TOKEN_END; value = ends_value(&lex)) {
		ahead = lex;
		if (lex.token.kind == TOKEN_NUMBER)
			good = literal_parse(lex.token.text, lex.token.len, &literal) != LITERAL_BAD;
		else if (lex.token.kind == TOKEN_NAME && !value && lex_next(&ahead) != TOKEN_END &&
			 lex_is(&ahead, "("))
			good = !is_wrong_call(m, lex, expr, diags);
	}
	free(diags);
	free(expr);
	return good;
}

static bool line_reads(const struct mender *m)
{
	struct project *project = m->in->project;
	const struct advice *advice = project->advice;
	struct diag_list *diags;
	bool good;

	if (m->full || m->in->kind == MEND_HEAD || strncmp(m->text, "END_", 4) == 0 ||
	    strncmp(m->text, "//", 2) == 0)
		return !m->full && m->changed && is_head(m);
	diags = calloc(1, sizeof(*diags));
	if (!diags)
		return false;
	project->advice = NULL;
	good = (m->in->kind == MEND_ROW ? row_reads(m, diags) : other_reads(m, diags)) &&
	       !diags->errors;
	project->advice = advice;
	free(diags);
	return good && numbers_read(m);
}

/* ---- decimal commas where a comma may separate ---- */

/* Makes a point of the comma at @at, or of the number around it one without thousands apart.
 * Returns the place behind the number. */
static size_t join_number(struct mender *m, size_t at)
{
	char made[MADE];
	size_t from = at, len;

	while (from && (ascii_digit(m->text[from - 1]) || m->text[from - 1] == '.'))
		from--;
	len = mend_groups(m->text, from, made, sizeof(made));
	if (from + len > at) {
		change(m, from, len, made);
		return from + strlen(made);
	}
	change(m, at, 1, ".");
	return at + 1 + mend_word_length(m->text + at + 1);
}

static void join_numbers(struct mender *m, int open)
{
	const bool declares = m->in->kind == MEND_VAR;
	int at = mend_next_decimal(m->text, 0, open, declares);

	while (at >= 0 && !m->full) {
		const size_t behind = join_number(m, (size_t)at);

		/* The comma behind a number that was joined separates. */
		at = mend_next_decimal(m->text, (int)behind + (m->text[behind] != '\0'), open,
				       declares);
	}
}

/* [1,5, 2,5] → [1.5, 2.5], SQRT(1,5) → SQRT(1.5): in all brackets, else in one of them. */
static void mend_commas(struct mender *m)
{
	const struct mender before = *m;
	const struct mended told = *m->out;
	int open = -1, at = -1;

	do {
		join_numbers(m, open);
		if (!m->full && line_reads(m))
			return;
		*m = before;
		*m->out = told;
		do
			at = mend_next_decimal(m->text, at + 1, -1, m->in->kind == MEND_VAR);
		while (at >= 0 && mend_bracket(m->text, (size_t)at) == open);
		open = at >= 0 ? mend_bracket(m->text, (size_t)at) : -1;
	} while (at >= 0);
}

/* ---- missing words and signs ---- */

/* Cell @n of a row: its bytes without blanks around. False: there is no more. */
static bool cell_at(const struct mender *m, int n, size_t *from, size_t *to)
{
	size_t at = 0, start = 0;
	int depth = 0, bars = 0;

	for (; at < m->len; at++) {
		depth += m->text[at] == '[' ? 1 : m->text[at] == ']' ? -1 : 0;
		if (m->text[at] != '|' || depth > 0)
			continue;
		if (bars++ == n + 1)
			break;
		start = at + 1;
	}
	if (bars < n + 2)
		return false;
	while (start < at && m->text[start] == ' ')
		start++;
	while (at > start && (m->text[at - 1] == ' ' || m->text[at - 1] == '^'))
		at--;
	*from = start;
	*to = at;
	return true;
}

static void add_bars(struct mender *m)
{
	size_t end = m->len;

	if (m->text[0] != '|')
		change(m, 0, 0, "| ");
	if (m->changed && m->out->id == DIAG_MISSING)
		snprintf(m->out->to, sizeof(m->out->to), "|");
	if (!strstr(m->text, "//") && !strstr(m->text, "(*") && m->text[(end = m->len) - 1] != '|')
		change(m, end, 0, m->text[end - 1] == ' ' ? "|" : " |");
}

static bool is_operator(char c)
{
	return c && strchr(":=<>+*", c);
}

static bool operator_follows(const struct mender *m, size_t at)
{
	while (m->text[at] == ' ')
		at++;
	return is_operator(m->text[at]);
}

/* ---- operands of cells ---- */

/* An operand at the cursor: a name with its path, an address or a constant. Returns its bytes; 0: none. */
static size_t plain_length(const struct mender *m, size_t at, size_t to)
{
	struct lex lex;
	size_t end = at;
	int depth = 0;

	if (at >= to) /* blanks alone */
		return 0;
	lex_init(&lex, m->text + at, to - at);
	lex_next(&lex);
	if (lex.token.kind != TOKEN_NAME && lex.token.kind != TOKEN_ADDRESS && lex.token.kind != TOKEN_NUMBER)
		return 0;
	do {
		depth += lex_is(&lex, "[") - lex_is(&lex, "]");
		end = (size_t)(lex.token.text + lex.token.len - m->text);
		lex_next(&lex);
	} while (lex.token.kind != TOKEN_END && (depth > 0 || lex_is(&lex, "[") ||
		 (!lex.token.space_before && !is_operator(*lex.token.text) && *lex.token.text != ',')));
	return end - at;
}

static size_t skip_blanks(const struct mender *m, size_t at)
{
	while (m->text[at] == ' ' || m->text[at] == ',')
		at++;
	return at;
}

/* Signs of comparison in a contact: `=` was taken for the one of a parameter. Returns the new end. */
static size_t compare_again(struct mender *m, size_t from, size_t to)
{
	for (size_t at = 0; at + 1 < m->in->len; at++)
		if (m->in->text[at] == ':' && m->in->text[at + 1] == '=')
			return to;
	for (size_t at = from; at + 1 < to; at++)
		if (m->text[at] == ':' && m->text[at + 1] == '=') {
			memmove(m->text + at, m->text + at + 1, m->len - at);
			m->len--;
			to--;
			m->changed = false;
		}
	return to;
}

/* Is there a sign or word that computes something? */
static bool has_operator(const struct mender *m, size_t from, size_t to)
{
	static const char *const words[] = { "AND", "OR", "XOR", "NOT", "MOD" };
	struct lex lex;

	lex_init(&lex, m->text + from, to - from);
	while (lex_next(&lex) != TOKEN_END) {
		if (lex.token.kind == TOKEN_SYMBOL && strchr("<>=+-*&/", *lex.token.text))
			return true;
		for (size_t i = 0; i < COUNT(words); i++)
			if (lex_is(&lex, words[i]))
				return true;
	}
	return false;
}

/* NO Start Ready → NO Start | NO Ready, COIL Lamp, Horn likewise; COIL Lamp := TRUE → COIL Lamp. */
static bool mend_more(struct mender *m, const struct word_row *row, size_t at, size_t to)
{
	size_t first = plain_length(m, at, to);
	const size_t sign = at + first + strspn(m->text + at + first, " :=");
	char made[MADE] = "";
	size_t used = 0, len;

	if (first && row->operand == OPND_BOOL_W && memchr(m->text + at + first, '=', sign - at - first) &&
	    ((to - sign == 1 && m->text[sign] == '1') || (to - sign == 4 && ascii_same(m->text + sign, "TRUE", 4)))) {
		m->changed = false;
		first += strspn(m->text + at + first, " ");
		change(m, at + first, to - at - first, "");
		return true;
	}
	if (ascii_is(row->word, m->text + at, first) && m->text[at + first] == ' ') { /* NO NO Start */
		change(m, at, first + 1, "");
		return true;
	}
	if (has_operator(m, at, to))
		return false;
	for (size_t next = at; next < to; next = skip_blanks(m, next + len)) {
		len = plain_length(m, next, to);
		if (!len || operator_follows(m, next + len) || used + len + 20 >= sizeof(made) || ascii_digit(m->text[next]) ||
		    (len > 1 && words_find(&m->in->project->words, m->text + next, len) != WORD_COUNT))
			return false;
		used += (size_t)snprintf(made + used, sizeof(made) - used, "%s%.*s", used ? " | " : "", (int)len,
					 m->text + next);
		if (next == at)
			continue;
		used -= len;
		used += (size_t)snprintf(made + used, sizeof(made) - used, "%s %.*s", row->word, (int)len,
					 m->text + next);
	}
	if (!first || used == first)
		return false;
	change(m, at, to - at, made);
	return true;
}

/* NO "Start": quotes around a name. */
static bool drop_quotes(struct mender *m, size_t at, size_t to)
{
	char made[MADE], from[sizeof(m->out->from)];

	if (to - at < 3 || m->text[at] != '\'' || m->text[to - 1] != '\'' ||
	    mend_word_length(m->text + at + 1) != to - at - 2)
		return false;
	memcpy(from, m->out->from, sizeof(from));
	snprintf(made, sizeof(made), "%.*s", (int)(to - at - 2), m->text + at + 1);
	if (!m->changed || (size_t)m->out->column == at + 1) {
		const bool told = m->changed;

		m->changed = false;
		change(m, at, to - at, made);
		if (told)
			memcpy(m->out->from, from, sizeof(from));
	} else {
		change(m, at, to - at, made);
	}
	return true;
}

/* The declaration for the edge of a value. */
static const char *edge_block(const struct word_row *row)
{
	return strcmp(row->word, "N") == 0 ? "Fall : F_TRIG" : "Rise : R_TRIG";
}

/* Are the parentheses at both ends a pair? */
static bool wraps(const struct mender *m, size_t at, size_t end)
{
	int depth = 0;

	for (size_t i = at; i < end; i++) {
		depth += m->text[i] == '(' ? 1 : m->text[i] == ')' ? -1 : 0;
		if (depth <= 0)
			return i + 1 == end && i > at;
	}
	return false;
}

/* P (NOT Start) → N Start, NO (Start) → NO Start, NO A AND B → [ A AND B ]. */
static bool mend_contact(struct mender *m, const struct word_row *row, size_t from, size_t word, size_t to)
{
	const char *const with[] = { "NC", "NO", "N", "P", "COILNOT", "COIL" };
	const char *const turned[] = { "NO", "NC", "P", "N", "COIL", "COILNOT" };
	const bool negated = row->negate, plain = row->edge == EDGE_NONE && row->operand == OPND_BOOL_R;
	size_t at = skip_blanks(m, from + word), end, len;
	const char *other = row->word;
	bool turn;
	char made[MADE];

	to = compare_again(m, from, to);
	if (at >= to) /* nothing stands there */
		return false;
	if (drop_quotes(m, at, to))
		return true;
	end = to;
	while (end - at > 2 && wraps(m, at, end)) {
		at = skip_blanks(m, at + 1);
		for (end--; end > at && m->text[end - 1] == ' '; end--)
			;
	}
	turn = end - at > 4 && ascii_same(m->text + at, "NOT", 3) && !mend_is_word(m->text[at + 3]);
	len = turn ? 3 : 0;
	if (!turn && end - at > 1 && strchr("/!", m->text[at])) {
		turn = true;
		len = 1;
	}
	for (size_t i = at + len; turn && i < end && (m->text[i] == ' ' || m->text[i] == '('); i++)
		len++;
	const size_t bare = plain_length(m, at + len, end);
	size_t rest = at + len + bare;

	while (turn && rest < end && (m->text[rest] == ' ' || m->text[rest] == ')'))
		rest++;
	if (bare && rest == end) {
		for (size_t i = 0; turn && i < COUNT(with); i++)
			if (!strcmp(row->word, with[i]))
				other = turned[i];
		if (turn && other == row->word)
			return false;
		if (!turn && m->text[skip_blanks(m, from + word)] != '(')
			return false;
		snprintf(made, sizeof(made), "%s %.*s", other, (int)bare, m->text + at + len);
	} else if (mend_more(m, row, skip_blanks(m, from + word), to)) {
		return true;
	} else if (row->edge != EDGE_NONE && row->operand == OPND_BOOL_R && to - at < MADE - 32 && has_operator(m, at, to)) {
		at = skip_blanks(m, from + word);
		snprintf(made, sizeof(made), "[ %.*s ] | %s %.4s", (int)(to - at), m->text + at, edge_block(row) + 7,
			 edge_block(row));
		m->changed = false;
		change(m, from, to - from, made);
		m->out->id = DIAG_EDGE_OF_VALUE;
		snprintf(m->out->from, sizeof(m->out->from), "%s", row->word);
		snprintf(m->out->to, sizeof(m->out->to), "%s", edge_block(row));
		return true;
	} else if (plain && to - at < MADE - 20 && has_operator(m, at, to)) {
		snprintf(made, sizeof(made), negated ? "[ NOT (%.*s) ]" : "[ %.*s ]", (int)(end - at), m->text + at);
		at = from;
		if (!negated && to - skip_blanks(m, from + word) < MADE - 20)
			snprintf(made, sizeof(made), "[ %.*s ]", (int)(to - skip_blanks(m, from + word)),
				 m->text + skip_blanks(m, from + word));
	} else {
		return false;
	}
	change(m, from, to - from, made);
	return true;
}

/* Blanks and the arrow before a result, as in ADD A B => Sum: its bytes; 0: there is none. */
static size_t result_arrow(const struct mender *m, size_t at)
{
	const size_t blanks = strspn(m->text + at, " ");
	const char *text = m->text + at + blanks;

	return text[0] == '=' && text[1] == '>' ? blanks + 2 + strspn(text + 2, " ") : 0;
}

/* More values than inputs that are no BOOL: the first one is the power, as TON Delay Start 5s says it in other
 * tools. 1: the others are those inputs; 2: all inputs behind the first; 0: none is the power. */
static int given_bits(const struct word_row *row, int count)
{
	int values = 0, inputs = 0;

	for (int i = 0; i < row->pin_count; i++) {
		inputs += row->pin[i].dir == PIN_IN;
		values += row->pin[i].dir == PIN_IN && row->pin[i].type != IEC_BOOL;
	}
	return count == values + 1 && inputs > values ? 1 : count > values && count == inputs ? 2 : 0;
}

/* The pin that a value without a name belongs to: from @pin on, and behind the first bit if that is the power. */
static int next_pin(const struct word_row *row, int pin, int bits, bool behind_power)
{
	while (pin < row->pin_count && (row->pin[pin].dir != PIN_IN ||
	       (row->pin[pin].type == IEC_BOOL && (bits < 2 || behind_power)))) {
		behind_power = behind_power && (row->pin[pin].dir != PIN_IN || row->pin[pin].type != IEC_BOOL);
		pin++;
	}
	return pin;
}

/* Behind the name of an instance at @at, without the brackets around what follows, as in TON Delay(PT:=5s);
 * @at: there is no name. @to: the end of the cell. */
static size_t behind_name(struct mender *m, size_t at, size_t *to)
{
	size_t len = mend_word_length(m->text + at);
	const size_t open = at + len + strspn(m->text + at + len, " ");

	if (!len)
		return at;
	if (m->text[open] == '(' && m->text[*to - 1] == ')') {
		change(m, --*to, 1, "");
		change(m, open, 1, " ");
	}
	if (strchr("[.", m->text[at + len]))
		len = plain_length(m, at, *to);
	return at + len;
}

/* TON Delay 5s → TON Delay PT:=T#5s, TON Delay Start 5s → NO Start | TON Delay PT:=T#5s, ADD A B Sum → ADD IN1:=A IN2:=B OUT=>Sum: the pins in their
 * order, of a block without those that are BOOL. */
static bool mend_values(struct mender *m, const struct word_row *row, size_t from, size_t word, size_t to)
{
	size_t at = skip_blanks(m, from + word), first = 0, len, value[8], size[8];
	char made[MADE] = "", last[24], contact[MADE];
	int count = 0, pin = 0, bits;
	size_t power;
	size_t named = 0, used = 0;

	if (row->kind == WORD_FB) {
		first = behind_name(m, at, &to);
		if (first == at)
			return false;
		at = skip_blanks(m, first);
	}
	first = first ? first : at;
	for (; at < to && count < 8; at = skip_blanks(m, at + len)) {
		len = mend_word_length(m->text + at);
		if (count == 0 && row->kind == WORD_FB && word_pin_find(row, m->text + at, len) >= 0) {
			named = at;
			at += len;
			at += strspn(m->text + at, " :");
			pin = word_pin_find(row, m->text + named, len);
			if (at - named == len || pin >= row->pin_count || row->pin[pin].dir != PIN_IN)
				return false;
		}
		len = row->kind == WORD_FN && count == 1 && ascii_same(m->text + at, "TO ", 3) ? 3 : 0;
		at += len;
		at += row->kind == WORD_FN && count ? result_arrow(m, at) : 0;
		len = plain_length(m, at, to);
		if (!len || (operator_follows(m, at + len) && !(row->kind == WORD_FN && result_arrow(m, at + len))))
			return false;
		value[count] = at;
		size[count++] = len;
	}
	if (!count || at < to || (row->kind == WORD_FN && row->pin_count == 0))
		return false;
	bits = row->kind == WORD_FB && !named ? given_bits(row, count) : 0;
	power = bits ? value[0] : 0;
	if (power && ascii_digit(m->text[power]))
		return false;
	snprintf(contact, sizeof(contact), "NO %.*s | ", (int)(power ? size[0] : 0), m->text + power);
	for (int i = power ? 1 : 0; i < count; i++, pin++) {
		const bool result = row->kind == WORD_FN && i == count - 1 && count > row->pin_count && !word_is_test(row);
		const char *name = NULL;

		pin = row->kind == WORD_FB ? next_pin(row, pin, bits, i == 1 && power) : pin;
		if (result) {
			name = "OUT";
		} else if (pin < row->pin_count) {
			name = row->pin[pin].name;
		} else if (row->kind == WORD_FN && pin < row->most_inputs) {
			snprintf(last, sizeof(last), "IN%d", word_last_number(row) + pin - row->pin_count + 1);
			name = last;
		}
		if (!name)
			return false;
		used += (size_t)snprintf(made + used, sizeof(made) - used, "%s%s%s%.*s", i || row->kind == WORD_FB ? " " : "", name, result ? "=>" : ":=",
				(int)size[i], m->text + value[i]);
		if (used >= sizeof(made))
			return false;
	}
	const bool told = m->changed;

	change(m, first, to - first, made);
	if (power)
		change(m, from, 0, contact);
	if (!m->full && (!told || m->out->id == DIAG_WRITE_INSTEAD)) {
		m->out->id = DIAG_MISSING;
		m->out->column = (int)value[0] + 1;
		snprintf(m->out->to, sizeof(m->out->to), "%.*s", (int)strcspn(made, "=") + 1 - (*made == ' '),
			 made + (*made == ' '));
	}
	return true;
}

static bool mend_known(struct mender *m, size_t from, size_t word, size_t to)
{
	struct word_table *words = &m->in->project->words;
	const enum word id = words_find(words, m->text + from, word);
	const struct word_row *row = words_row(words, id);

	if (row->kind == WORD_FB || row->kind == WORD_FN)
		return m->text[from + word] == ' ' && mend_values(m, row, from, word, to);
	return row->kind == WORD_ELEM && (row->operand == OPND_BOOL_R || row->operand == OPND_BOOL_W) &&
	       mend_contact(m, row, from, word, to);
}

/* Does a word join values, as in Start AND NOT Stop? A sign may be a part of a name that is none here: Start-1. */
static bool joins(const struct mender *m, size_t from, size_t to)
{
	struct lex lex;
	bool is = false;

	lex_init(&lex, m->text + from, to - from);
	lex_next(&lex);
	while (lex_next(&lex) != TOKEN_END && !is)
		is = lex_is(&lex, "AND") || lex_is(&lex, "OR") || lex_is(&lex, "XOR") || lex_is(&lex, "&");
	return is;
}

/* Start → NO Start, (Motor) → COIL Motor, N := 1 → [ N := 1 ], TON(D, PT := …) → TON D PT:=… */
static void mend_cell(struct mender *m, size_t from, size_t to, bool last)
{
	const size_t word = mend_word_length(m->text + from);
	const bool known = word && !operator_follows(m, from + word) &&
			   words_find(&m->in->project->words, m->text + from, word) !=
				   WORD_COUNT;
	size_t at = from;

	if (m->text[from] == '(' && m->text[to - 1] == ')') {
		char made[MADE];

		snprintf(made, sizeof(made), "COIL %.*s", (int)(to - from) - 2,
			 m->text + from + 1);
		change(m, from, to - from, made);
		return;
	}
	if (m->text[from] == '-' && to - from < 3) {
		change(m, from, to - from, "---");
		return;
	}
	if (known && mend_known(m, from, word, to))
		return;
	if (known && m->text[from + word] == '(' && m->text[to - 1] == ')') {
		change(m, from + word, 1, " ");
		change(m, to - 1, 1, "");
		for (at = from; at < to && m->text[at] != '|'; at++)
			if (m->text[at] == ',')
				change(m, at, 1, "");
		for (at = from; at < m->len && m->text[at] != '|'; at++)
			;
		while (at > from && m->text[at - 1] == ' ')
			at--;
		mend_known(m, from, word, at);
		return;
	}
	if (ascii_same(m->text + from, "NOT ", 4) && mend_word_length(m->text + from + 4) &&
	    from + 4 + mend_word_length(m->text + from + 4) == to) {
		change(m, from, 3, "NC");
		return;
	}
	if (known || m->text[from] == '[' || m->text[from] == '.' || from == to)
		return;
	while (at < to && !is_operator(m->text[at]))
		at++;
	if (at < to || joins(m, from, to)) {
		change(m, to, 0, " ]");
		change(m, from, 0, "[ ");
		snprintf(m->out->to, sizeof(m->out->to), "[ ]");
		m->out->column = (int)from + 1;
	} else if (!memchr(m->text + from, ' ', to - from)) {
		change(m, from, 0, last ? "COIL " : "NO ");
		snprintf(m->out->to, sizeof(m->out->to), last ? "COIL" : "NO");
	}
}

/* N++ → N := N + 1, N += 2 → N := N + 2. */
static void mend_steps(struct mender *m)
{
	char made[MADE];
	size_t start, name;
	char *at = strstr(m->text, "++");
	const bool one = at;

	if (!at)
		at = strstr(m->text, "+=");
	if (!at)
		at = strstr(m->text, "-=");
	if (!at)
		return;
	for (start = (size_t)(at - m->text); start && m->text[start - 1] != '['; start--)
		;
	while (m->text[start] == ' ')
		start++;
	for (name = (size_t)(at - m->text) - start; name && m->text[start + name - 1] == ' '; name--)
		;
	if (name > 30)
		return;
	snprintf(made, sizeof(made), "%.*s := %.*s %c%s", (int)name, m->text + start,
		 (int)name, m->text + start, *at, one ? " 1" : "");
	change(m, start, (size_t)(at - m->text) + 2 - start, made);
}

/* ---- expressions where only a name or a number can stand ---- */

/* The first bytes of a computation, for the message. */
static void show_computed(struct mender *m, size_t at, size_t len)
{
	const char *text = m->text + at;
	const size_t most = sizeof(m->out->from) - sizeof("…");
	size_t used = 0;

	while (used < len && used + utf8_length(text + used, len - used) <= most)
		used += utf8_length(text + used, len - used);
	snprintf(m->out->from, sizeof(m->out->from), "%.*s%s", (int)used, text,
		 used < len ? "…" : "");
}

/* The text at the cursor is an expression. @more: it is more than a name or a number; @inner:
 * of `(A)` and `A` the name. */
static bool is_computed(const char *text, size_t len, bool index, bool *more,
			struct expr_tail *inner)
{
	struct expr *expr = malloc(sizeof(*expr));
	struct diag_list *diags = calloc(1, sizeof(*diags));
	struct lex lex;
	bool good = false;

	lex_init(&lex, text, len);
	lex_next(&lex);
	if (expr && diags)
		good = expr_parse(&lex, expr, diags, (struct diag){ .id = DIAG_BAD_EXPRESSION }) &&
		       lex.token.kind == TOKEN_END;
	if (good) {
		const struct expr_node *root = &expr->node[expr->root];
		const bool plain = root->op == EXPR_NAME || root->op == EXPR_LITERAL;

		*more = !plain || (index && memchr(text, '[', len)) || *text == '(';
		*inner = plain ? (struct expr_tail){ root->text, root->len } :
				 (struct expr_tail){ 0 };
	}
	free(diags);
	free(expr);
	return good;
}

/* Bytes up to the , or bracket outside of its own that ends the operand at @at, or up to a comment. */
static size_t operand_length(const struct mender *m, size_t at)
{
	size_t end = at;
	int depth = 0;

	for (; end < m->len && skip_comment(m, end) == end; end++) {
		const char c = m->text[end];

		if (depth == 0 && strchr(",)]|", c))
			break;
		depth += c == '(' || c == '[' ? 1 : c == ')' || c == ']' ? -1 : 0;
	}
	while (end > at && m->text[end - 1] == ' ')
		end--;
	return end - at;
}

/* Puts @name in the place of @len bytes, if they are computed. Returns the bytes there now. */
static size_t take_computed(struct mender *m, size_t at, size_t len, const char *name)
{
	const bool index = strcmp(name, "Index") == 0, told = m->changed;
	const bool bracket = !index && len > 2 && m->text[at] == '[' && m->text[at + len - 1] == ']';
	const char *text = m->text + at + bracket;
	struct expr_tail inner;
	char made[MADE];
	bool more;

	if (!is_computed(text, len - 2 * bracket, index, &more, &inner) || !(more || bracket))
		return len;
	if (index)
		inner.len = 0;
	snprintf(made, sizeof(made), "%.*s", inner.len ? (int)inner.len : (int)strlen(name),
		 inner.len ? inner.text : name);
	if (inner.len == 0 && !told)
		show_computed(m, at, len);
	m->changed |= inner.len == 0;
	change(m, at, len, made);
	if (inner.len == 0 && !told) {
		m->out->id = DIAG_COMPUTED;
		m->out->column = (int)at + 1;
	}
	return strlen(made);
}

/* T[A + 1] → T[Index]; not in [ … ] of a cell, which may hold an expression. */
static void mend_indices(struct mender *m)
{
	size_t at = 0;

	while (at < m->len && !m->full) {
		const bool index = m->text[at] == '[' && at && mend_is_word(m->text[at - 1]);

		if (skip_comment(m, at) != at)
			at = skip_comment(m, at);
		else if (index)
			at += 1 + take_computed(m, at + 1, operand_length(m, at + 1), "Index");
		else if (m->text[at] == '[')
			at += 1 + operand_length(m, at + 1);
		else
			at++;
	}
}

/* Behind the instruction at the cursor whose operand is a value, and behind its parenthesis; 0:
 * it has none. */
static size_t value_place(const struct mender *m)
{
	const size_t label = mend_word_length(m->text);
	size_t at = m->text[label] == ':' ? label + 1 : 0, len;
	struct word_table *words = &m->in->project->words;
	enum op op;
	enum word word;

	while (m->text[at] == ' ')
		at++;
	len = mend_word_length(m->text + at);
	op = op_find(m->text + at, len);
	word = words_find(words, m->text + at, len);
	if (op == OP_COUNT && len > 1 && ascii_upper(m->text[at + len - 1]) == 'N')
		op = op_find(m->text + at, len - 1);
	if (op != OP_COUNT ? op_row(op)->operand != OPND_ANY_R && op_row(op)->operand != OPND_INSTANCE :
			     word == WORD_COUNT || words_row(words, word)->kind != WORD_FN)
		return 0;
	at += len;
	if (op != OP_COUNT && op_row(op)->operand == OPND_INSTANCE)
		at += strcspn(m->text + at, "(");
	if (m->text[at] == '(')
		return at + 1;
	return at;
}

/* LD A + 1 → LD Value; ADD(IN1 := A * 2, IN2 := B) → ADD(IN1 := Value, IN2 := B). */
static void mend_operands(struct mender *m)
{
	size_t at = value_place(m), pin;

	while (at && at < m->len && !m->full) {
		while (m->text[at] == ' ')
			at++;
		pin = at + mend_word_length(m->text + at);
		while (m->text[pin] == ' ')
			pin++;
		if (m->text[pin] == ':' && m->text[pin + 1] == '=')
			at = pin + 2;
		while (m->text[at] == ' ')
			at++;
		at += take_computed(m, at, operand_length(m, at), "Value");
		if (m->text[at] != ',')
			return;
		at++;
	}
}

static void mend_row(struct mender *m)
{
	size_t from, to, more;

	mend_indices(m);
	if (m->changed && line_reads(m))
		return;
	mend_steps(m);
	add_bars(m);
	for (int n = 0; cell_at(m, n, &from, &to) && !m->full && n < LIMIT_COLS; n++) {
		for (size_t at = from; at + 1 < to; at++)
			if (skip_comment(m, at) != at)
				to = at;
		while (to > from && m->text[to - 1] == ' ')
			to--;
		if (to > from)
			mend_cell(m, from, to, n > 0 && !cell_at(m, n + 1, &more, &more));
	}
}

/* ---- declarations ---- */

struct piece {
	size_t at, len;
};

/* Up to @most tokens of the line. */
static int split(const struct mender *m, struct piece *piece, int most)
{
	struct lex lex;
	int count = 0;

	lex_init(&lex, m->text, m->len);
	while (count < most && lex_next(&lex) != TOKEN_END)
		piece[count++] = (struct piece){ (size_t)(lex.token.text - m->text),
						 lex.token.len };
	return count;
}

static bool piece_is(const struct mender *m, struct piece piece, const char *text)
{
	return ascii_is(text, m->text + piece.at, piece.len);
}

static bool is_type(const struct mender *m, struct piece piece)
{
	const char *text = m->text + piece.at;
	enum word word;

	if (iec_type_find(text, piece.len) != IEC_NONE || piece_is(m, piece, "ARRAY"))
		return true;
	word = words_find(&m->in->project->words, text, piece.len);
	return word != WORD_COUNT &&
	       (words_row(&m->in->project->words, word)->kind == WORD_FB ||
		words_row(&m->in->project->words, word)->kind == WORD_STRUCT);
}

/* Type first: BOOL Start → Start : BOOL. */
static void turn_type(struct mender *m, const struct piece *piece, int count)
{
	char made[MADE];

	if (count < 2 || !is_type(m, piece[0]) || !mend_is_word(m->text[piece[1].at]) ||
	    (count > 2 && piece_is(m, piece[2], ":")))
		return;
	snprintf(made, sizeof(made), "%.*s : %.*s", (int)piece[1].len, m->text + piece[1].at,
		 (int)piece[0].len, m->text + piece[0].at);
	change(m, piece[0].at, piece[1].at + piece[1].len - piece[0].at, made);
}

/* Start button → Start_button, Start-button likewise; 1Start → _1Start. */
static void join_name(struct mender *m, const struct piece *piece, int count)
{
	char made[MADE];
	int last = 0;

	if (!count)
		return;
	if (ascii_digit(m->text[piece[0].at])) {
		change(m, piece[0].at, 0, "_");
		return;
	}
	for (int i = 1; i < count; i++) {
		if (piece_is(m, piece[i], ":") || piece_is(m, piece[i], "AT"))
			break;
		if (is_type(m, piece[i]) || m->text[piece[i].at] == '%')
			return;
		if (!mend_is_word(m->text[piece[i].at]) && !piece_is(m, piece[i], "-"))
			return;
		last = i;
	}
	if (!last)
		return;
	snprintf(made, sizeof(made), "%.*s", (int)(piece[last].at + piece[last].len -
						   piece[0].at), m->text + piece[0].at);
	for (char *at = made; *at; at++)
		if (!mend_is_word(*at))
			*at = '_';
	change(m, piece[0].at, piece[last].at + piece[last].len - piece[0].at, made);
}

/* An address stands behind AT, between name and colon. */
static void move_address(struct mender *m, const struct piece *piece, int count)
{
	char made[MADE];

	for (int i = 1; i < count; i++) {
		const bool at = piece_is(m, piece[i - 1], "AT");

		if (m->text[piece[i].at] != '%')
			continue;
		if (i == 1 && !at) { /* Name %IX0.0 : BOOL */
			change(m, piece[i].at, 0, "AT ");
			snprintf(m->out->to, sizeof(m->out->to), "AT");
		} else if (memchr(m->text, ':', piece[i].at)) { /* Name : BOOL AT %IX0.0 */
			size_t from = piece[i - at].at, len = piece[i].at + piece[i].len - from;

			snprintf(made, sizeof(made), " AT %.*s", (int)piece[i].len,
				 m->text + piece[i].at);
			while (from && m->text[from - 1] == ' ')
				from--, len++;
			change(m, from, len, "");
			change(m, piece[0].at + piece[0].len, 0, made);
			m->out->id = DIAG_MISPLACED_PART;
			snprintf(m->out->from, sizeof(m->out->from), "%.20s", made + 1);
		}
		return;
	}
}

/* Name BOOL → Name : BOOL; Name := BOOL likewise. */
static void add_colon(struct mender *m, const struct piece *piece, int count)
{
	for (int i = 1; i < count && !piece_is(m, piece[i], ":"); i++) {
		if (!is_type(m, piece[i]))
			continue;
		if (piece_is(m, piece[i - 1], ":="))
			change(m, piece[i - 1].at, 2, ":");
		else
			change(m, piece[i].at, 0, ": ");
		if (m->out->id == DIAG_MISSING)
			snprintf(m->out->to, sizeof(m->out->to), ":");
		return;
	}
}

/* STRING(20) → STRING[20], INT[10] and ARRAY[10] OF → ARRAY[0..9] OF, 1-10 → 1..10. */
static void mend_bounds(struct mender *m, const struct piece *piece, int count)
{
	struct literal size;
	char made[MADE];
	int i = 0;

	while (i < count && !piece_is(m, piece[i], ":"))
		i++;
	if (i + 4 >= count || !is_type(m, piece[i + 1]) ||
	    !(piece_is(m, piece[i + 2], "[") || piece_is(m, piece[i + 2], "(")))
		return;
	const struct piece *type = &piece[i + 1], *low = &piece[i + 3];
	const bool array = piece_is(m, *type, "ARRAY"), text = piece_is(m, *type, "STRING");
	const bool one = piece_is(m, piece[i + 4], "]") || piece_is(m, piece[i + 4], ")");

	if (low->len > 6 ||
	    literal_parse(m->text + low->at, low->len, &size) != LITERAL_OK || size.real || (!one && (i + 6 >= count || !array ||
	    !ascii_digit(m->text[piece[i + 5].at]))) || piece_is(m, piece[i + 4], "."))
		return;
	if (text)
		snprintf(made, sizeof(made), "STRING[%.*s]", (int)low->len, m->text + low->at);
	else if (one)
		snprintf(made, sizeof(made), "ARRAY[0..%d]%s%.*s", (int)size.value.i - 1,
			 array ? "" : " OF ", array ? 0 : (int)type->len, m->text + type->at);
	else
		snprintf(made, sizeof(made), "ARRAY[%.*s..%.*s]", (int)low->len,
			 m->text + low->at, (int)piece[i + 5].len, m->text + piece[i + 5].at);
	if (text && piece_is(m, piece[i + 2], "["))
		return;
	change(m, type->at, piece[i + (one ? 4 : 6)].at + 1 - type->at, made);
}

/* T : TIME := 5000 → T#5000ms, N : INT 5 → N : INT := 5. */
static void mend_value(struct mender *m, const struct piece *piece, int count)
{
	char made[MADE];

	for (int i = 2; i < count; i++) {
		const char *text = m->text + piece[i].at;

		if (!ascii_digit(*text) || piece_is(m, piece[i - 1], "["))
			continue;
		if (is_type(m, piece[i - 1])) {
			change(m, piece[i].at, 0, ":= ");
			snprintf(m->out->to, sizeof(m->out->to), ":=");
		} else if (i > 2 && piece_is(m, piece[i - 1], ":=") &&
			   piece_is(m, piece[i - 2], "TIME") && piece[i].len < 12) {
			snprintf(made, sizeof(made), "T#%.*sms", (int)piece[i].len, text);
			change(m, piece[i].at, piece[i].len, made);
		}
		return;
	}
}

static void add_semicolon(struct mender *m, const struct piece *piece, int count)
{
	const struct piece *last = &piece[count - 1];
	size_t end;

	if (!count || piece_is(m, *last, ";"))
		return;
	end = last->at + last->len;
	if (piece_is(m, *last, ",") || piece_is(m, *last, "."))
		change(m, last->at, 1, ";");
	else
		change(m, end, 0, ";");
}

static void mend_var(struct mender *m)
{
	static void (*const steps[])(struct mender *, const struct piece *, int) = {
		turn_type, move_address, add_colon, join_name, mend_bounds, mend_value,
		add_semicolon,
	};
	struct piece piece[24];

	for (size_t i = 0; i < COUNT(steps) && !m->full && !line_reads(m); i++)
		steps[i](m, piece, split(m, piece, 24));
}

/* ---- lists and heads ---- */

static void mend_list(struct mender *m)
{
	struct piece piece[8];
	int count = split(m, piece, 8);

	mend_indices(m);
	if (!m->full && !line_reads(m))
		mend_operands(m);
	if (m->changed)
		return;
	if (count == 1 && m->in->label) {
		change(m, piece[0].len + piece[0].at, 0, ":");
	} else if (count == 3 && piece_is(m, piece[2], ":")) {
		change(m, piece[2].at, 1, "");
	} else if (count == 3 && piece_is(m, piece[1], ":=")) {
		change(m, piece[1].at, 3, "");
	}
}

/* STEP Fill → STEP Fill: */
static void mend_step(struct mender *m, const struct piece *piece, int count)
{
	if (count == 2 || (!piece_is(m, piece[2], ":") && !piece_is(m, piece[count - 1], ":")))
		change(m, piece[count - 1].at + piece[count - 1].len, 0, ":");
}

static bool condition_reads(const struct mender *m, size_t at)
{
	struct expr *expr = malloc(sizeof(*expr));
	struct diag_list *diags = calloc(1, sizeof(*diags));
	struct lex lex;
	bool good = false;

	lex_init(&lex, m->text + at, m->len - at);
	lex_next(&lex);
	if (expr && diags)
		good = expr_parse_cell(&lex, expr, diags, (struct diag){ .id = DIAG_BAD_EXPRESSION }) &&
		       lex_is(&lex, ";") && !expr->target &&
		       !expr_has_wrong_call(expr, &m->in->project->words);
	free(diags);
	free(expr);
	return good;
}

/* A == 5 && B; → A = 5 AND B; from byte @from to the semicolon. */
static void mend_condition(struct mender *m, size_t from)
{
	size_t at = from;

	m->where = IN_EXPR;
	m->depth = 0;
	while (at < m->len && m->text[at] != ';' && !m->full)
		at = m->text[at] == ' ' ? at + 1 : take_one(m, at);
	if (!m->full && !condition_reads(m, from))
		join_numbers(m, -1);
	m->full = m->full || !condition_reads(m, from);
}

/* TRANSITION A TO B = Start → TRANSITION FROM A TO B := Start; END_TRANSITION */
static void mend_transition(struct mender *m, const struct piece *piece, int count)
{
	int to = 0, assign = 0, ends = 0;

	for (int i = count - 1; i > 0; i--) {
		to = piece_is(m, piece[i], "TO") ? i : to;
		assign = piece_is(m, piece[i], ":=") ? i : assign;
		ends = piece_is(m, piece[i], ";") || piece_is(m, piece[i], "END_TRANSITION") ? i :
		       ends;
	}
	if (to == 2 && !piece_is(m, piece[1], "FROM"))
		change(m, piece[1].at, 0, "FROM ");
	else if (to && !assign && to + 2 < count && piece_is(m, piece[to + 2], "="))
		change(m, piece[to + 2].at, 1, ":=");
	else if (assign && ends > assign + 1 && piece_is(m, piece[ends], "END_TRANSITION"))
		change(m, piece[ends - 1].at + piece[ends - 1].len, 0, ";");
	else if (assign && !ends && assign + 1 < count)
		change(m, m->len, 0, "; END_TRANSITION");
	else if (assign)
		mend_condition(m, piece[assign].at + 2);
}

/* RUNG Start the motor → RUNG "Start the motor"; PROGRAM "Main" LD → PROGRAM Main LD. */
static void mend_head(struct mender *m)
{
	struct piece piece[32];
	char made[MADE];
	int count = split(m, piece, 32);
	size_t end = m->len;

	if (count < 2)
		return;
	if (is_of_chart(m)) {
		(piece_is(m, piece[0], "TRANSITION") ? mend_transition : mend_step)(m, piece, count);
		return;
	}
	if (piece_is(m, piece[0], "RUNG") && m->text[piece[1].at] != '"') {
		size_t from = piece[1].at + (m->text[piece[1].at] == ':' ||
					     m->text[piece[1].at] == '\'');

		while (from < end && m->text[from] == ' ')
			from++;
		while (end > from && (m->text[end - 1] == ' ' || m->text[end - 1] == '\''))
			end--;
		if (!memchr(m->text + from, '"', end - from)) {
			snprintf(made, sizeof(made), " \"%.*s\"", (int)(end - from),
				 m->text + from);
			change(m, piece[0].len, m->len - piece[0].len, made);
			m->out->id = DIAG_MISSING;
			m->out->column = (int)piece[1].at + 1;
			snprintf(m->out->to, sizeof(m->out->to), "\"");
		}
	} else if (m->text[piece[1].at] == '"' && !piece_is(m, piece[0], "PROJECT") &&
		   !piece_is(m, piece[0], "RUNG") && piece[1].len > 2) {
		snprintf(made, sizeof(made), "%.*s", (int)piece[1].len - 2,
			 m->text + piece[1].at + 1);
		change(m, piece[1].at, piece[1].len, made);
	}
}

/* ---- all of it ---- */

/* The line with single blanks, cut at a whole character. */
static void put_line(const struct mender *m, struct mended *out)
{
	size_t used = 0, step;

	for (size_t at = 0; at < m->len; at += step) {
		step = utf8_length(m->text + at, m->len - at);
		step = step ? step : 1;
		if (m->text[at] == ' ' && (!used || out->line[used - 1] == ' '))
			continue;
		if (used + step >= sizeof(out->line))
			break;
		memcpy(out->line + used, m->text + at, step);
		used += step;
	}
	while (used && out->line[used - 1] == ' ')
		used--;
	out->line[used] = '\0';
}

/* As mend_line(). @habits: whole cells are written anew first. */
static bool mend_once(const struct mend_line *line, struct mended *out, bool habits)
{
	static void (*const mend[])(struct mender *) = {
		[MEND_HEAD] = mend_head, [MEND_ROW] = mend_row, [MEND_VAR] = mend_var,
		[MEND_LIST] = mend_list,
	};
	struct mender m = { .in = line, .out = out, .len = line->len };
	size_t lead = 0;

	while (lead < line->len && (line->text[lead] == ' ' || line->text[lead] == '\t'))
		lead++;
	m.len -= lead;
	memcpy(m.text, line->text + lead, m.len);
	for (size_t i = 0; i < m.len; i++)
		if (m.text[i] == '\t')
			m.text[i] = ' ';
	while (m.len && m.text[m.len - 1] == ' ')
		m.len--;
	m.text[m.len] = '\0';
	if (!m.len)
		return false;
	replace_signs(&m);
	if (habits) {
		struct mended more = { 0 };

		const bool drawn = !m.changed && mend_drawn(m.text, MOST - 32, out);

		if (m.changed || (!mend_habits(line->project, m.text, MOST - 32, drawn ? &more : out) && !drawn))
			return false;
		m.changed = true;
		m.len = strlen(m.text);
	}
	if (line->kind != MEND_HEAD || !is_of_chart(&m))
		replace_words(&m);
	if (!m.full && line->kind != MEND_HEAD && !line_reads(&m))
		mend_commas(&m);
	if (!m.full && (line->kind == MEND_HEAD ? !m.changed : !line_reads(&m)))
		mend[line->kind](&m);
	if (!m.changed || !line_reads(&m))
		return false;
	out->column += (int)lead;
	put_line(&m, out);
	return true;
}

static bool is_drawn(const struct mend_line *line)
{
	char text[MOST];

	snprintf(text, sizeof(text), "%.*s", (int)line->len, line->text);
	return mend_is_drawn(text);
}

bool mend_line(const struct mend_line *line, struct mended *out)
{
	if (line->len >= MOST - 32 || memchr(line->text, '\037', line->len))
		return false;
	if (line->kind == MEND_LIST && mend_in_steps(line, out))
		return true;
	if (line->kind == MEND_HEAD && is_drawn(line)) /* nobody means a comment */
		return false;
	return (line->kind == MEND_ROW && mend_once(line, out, true)) || mend_once(line, out, false);
}
