/* SPDX-License-Identifier: MIT
 *
 * rung_language - prints a language file for GtkSourceView: of rung files and lists, or with the
 * argument "st" of Structured Text.
 *
 * The build runs it. The words come from the catalogue and the reader. The colour of a word
 * depends on its place, as its meaning does: an element after a bar, an operator at the
 * beginning of a line, a type after a colon.
 */
#include "engine/base/catalog.h"
#include "engine/check/reserved.h"
#include "engine/model/sfc.h"
#include "engine/model/st.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

static bool is_word(const char *word)
{
	if (!isalpha((unsigned char)word[0]))
		return false;
	for (; *word; word++)
		if (!isalnum((unsigned char)*word) && *word != '_')
			return false;
	return true;
}

/* "LD" or "|LD": the next word of an alternation. */
static void also(bool *first, const char *word, const char *behind)
{
	if (!is_word(word))
		return;
	printf("%s%s%s", *first ? "" : "|", word, behind);
	*first = false;
}

static bool is_type(const char *word)
{
	for (int i = 1; i < IEC_TYPE_COUNT; i++)
		if (strcmp(iec_type_row((enum iec_type)i)->word, word) == 0)
			return true;
	return false;
}

static bool is_constant(const char *word)
{
	return strcmp(word, "TRUE") == 0 || strcmp(word, "FALSE") == 0;
}

static void words_of_elements(void)
{
	bool first = true;

	for (int i = ELEM_WIRE + 1; i < WORD_COUNT; i++)
		also(&first, word_row((enum word)i)->word, "");
}

static void words_of_boxes(bool *first, enum word_kind kind)
{
	for (int i = ELEM_WIRE + 1; i < WORD_COUNT; i++)
		if (word_row((enum word)i)->kind == kind)
			also(first, word_row((enum word)i)->word, "");
}

static void operators(void)
{
	bool first = true;

	for (int i = 0; i < OP_COUNT; i++) {
		const struct op_row *row = op_row((enum op)i);

		also(&first, row->word, row->modifiers & MOD_C ? "C?N?" :
		     row->modifiers & MOD_N ? "N?" : "");
	}
	words_of_boxes(&first, WORD_FN);
}

static void types(void)
{
	bool first = true;

	for (int i = 1; i < IEC_TYPE_COUNT; i++)
		also(&first, iec_type_row((enum iec_type)i)->word, "");
	words_of_boxes(&first, WORD_FB);
}

/* @operators: also AND, which begins an instruction of a list. */
static void keywords(bool operators)
{
	const char *word;

	for (int i = 0; (word = reserved_word(i)); i++)
		if (is_word(word) && strlen(word) > 1 && !is_type(word) && !is_constant(word) &&
		    (operators || op_find(word, strlen(word)) == OP_COUNT))
			printf("      <keyword>%s</keyword>\n", word);
}

/* The words that a line of a chart begins with, and those that end a body behind other
 * words. */
static void words_of_charts(void)
{
	bool first = true;

	for (int i = 0; sfc_word(i); i++)
		also(&first, sfc_word(i)->word, "");
}

/* The same in Structured Text, where a name may stand: not SET or CONTROL. */
static void heads_of_charts(void)
{
	bool first = true;

	for (int i = 0; sfc_word(i); i++)
		if (sfc_word(i)->kind != SFC_WORD_SETTING && sfc_word(i)->kind != SFC_WORD_CONTROL)
			also(&first, sfc_word(i)->word, "");
}

static void ends_of_charts(void)
{
	bool first = true;

	for (int i = 0; sfc_word(i); i++)
		if (sfc_word(i)->kind == SFC_WORD_END)
			also(&first, sfc_word(i)->word, "");
}

/* Around the lines of an EXECUTE box. */
static void words_of_bodies(void)
{
	bool first = true;

	also(&first, word_row(ELEM_EXECUTE)->word, "");
	also(&first, "END_EXECUTE", "");
}

static void match(const char *id, const char *style, const char *before, void (*words)(void),
		  const char *behind)
{
	printf("    <context id=\"%s\">\n      <match>%s(", id, before);
	words();
	printf(")%s</match>\n      <include>\n"
	       "        <context sub-pattern=\"1\" style-ref=\"%s\"/>\n"
	       "      </include>\n    </context>\n", behind, style);
}

static void head(const char *id, const char *name, const char *mime, const char *globs)
{
	static const char *const styles[][2] = {
		{ "comment", "comment" }, { "string", "string" }, { "keyword", "keyword" },
		{ "element", "keyword" }, { "operator", "keyword" }, { "type", "type" },
		{ "constant", "special-constant" }, { "number", "number" },
		{ "address", "identifier" }, { "function", "function" },
		{ "pragma", "preprocessor" }, { "escape", "special-char" },
	};

	printf("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
	       "<language id=\"%s\" name=\"%s\" version=\"2.0\" section=\"Source\">\n"
	       "  <metadata>\n"
	       "    <property name=\"mimetypes\">%s</property>\n"
	       "    <property name=\"globs\">%s</property>\n"
	       "    <property name=\"line-comment-start\">//</property>\n"
	       "    <property name=\"block-comment-start\">(*</property>\n"
	       "    <property name=\"block-comment-end\">*)</property>\n"
	       "  </metadata>\n  <styles>\n", id, name, mime, globs);
	for (size_t i = 0; i < sizeof(styles) / sizeof(styles[0]); i++)
		printf("    <style id=\"%s\" name=\"%s\" map-to=\"def:%s\"/>\n",
		       styles[i][0], styles[i][0], styles[i][1]);
	printf("  </styles>\n"
	       "  <default-regex-options case-sensitive=\"false\"/>\n  <definitions>\n");
}

static void literals(void)
{
	printf("    <context id=\"block-comment\" style-ref=\"comment\" class=\"comment\">\n"
	       "      <start>\\(\\*</start><end>\\*\\)</end>\n    </context>\n"
	       "    <context id=\"line-comment\" style-ref=\"comment\" class=\"comment\" end-at-line-end=\"true\">\n"
	       "      <start>//</start>\n    </context>\n"
	       "    <context id=\"string\" style-ref=\"string\" class=\"string\" end-at-line-end=\"true\">\n"
	       "      <start>\"</start><end>\"</end>\n    </context>\n"
	       "    <context id=\"text\" style-ref=\"string\" class=\"string\" end-at-line-end=\"true\">\n"
	       "      <start>'</start><end>'</end>\n    </context>\n"
	       "    <context id=\"address\" style-ref=\"address\">\n"
	       "      <match>%%\\w[\\w.]*</match>\n    </context>\n"
	       "    <context id=\"constant\" style-ref=\"constant\">\n"
	       "      <keyword>TRUE</keyword>\n      <keyword>FALSE</keyword>\n"
	       "    </context>\n"
	       "    <context id=\"number\" style-ref=\"number\">\n"
	       "      <match>\\b(\\w+#[\\w.:+-]+|[0-9][0-9_]*(\\.[0-9]+)?(E[+-]?[0-9]+)?)\\b"
	       "</match>\n    </context>\n");
}

static void foot(const char *id, const char *const *order)
{
	printf("    <context id=\"%s\">\n      <include>\n", id);
	for (; *order; order++)
		printf("        <context ref=\"%s\"/>\n", *order);
	printf("      </include>\n    </context>\n  </definitions>\n</language>\n");
}

static void rung_files(void)
{
	static const char *const order[] = {
		"block-comment", "line-comment", "string", "text", "address", "element",
		"type", "chart", "chart-end", "body", "operator", "keyword", "constant", "number", NULL,
	};

	head("rung", "Rungboard", "text/x-rungboard", "*.rung");
	literals();
	match("element", "element", "(?&lt;=\\|)\\s*", words_of_elements, "\\b");
	match("type", "type", ":\\s*", types, "\\b");
	match("chart", "keyword", "^\\s*", words_of_charts, "\\b(?!\\s*[:,])");
	match("chart-end", "keyword", "\\b", ends_of_charts, "\\b");
	match("body", "keyword", "^\\s*", words_of_bodies, "\\b(?!\\s*(:=|\\())");
	match("operator", "operator", "^\\s*(?:\\w+:\\s*)?", operators, "\\b(?!\\s*:)");
	printf("    <context id=\"keyword\" style-ref=\"keyword\">\n");
	keywords(false);
	printf("    </context>\n");
	foot("rung", order);
}

/* ---- Structured Text ---- */

/* Comments are nested; $ escapes a character of a string. */
static void st_literals(void)
{
	static const char *const quoted[][2] = { { "string", "\"" }, { "text", "'" } };

	printf("    <context id=\"block-comment\" style-ref=\"comment\" class=\"comment\">\n"
	       "      <start>\\(\\*</start><end>\\*\\)</end>\n      <include>\n"
	       "        <context ref=\"block-comment\"/>\n      </include>\n    </context>\n"
	       "    <context id=\"pragma\" style-ref=\"pragma\" class=\"comment\">\n"
	       "      <start>\\{</start><end>\\}</end>\n    </context>\n"
	       "    <context id=\"line-comment\" style-ref=\"comment\" class=\"comment\" end-at-line-end=\"true\">\n"
	       "      <start>//</start>\n    </context>\n");
	for (size_t i = 0; i < sizeof(quoted) / sizeof(quoted[0]); i++)
		printf("    <context id=\"%s\" style-ref=\"string\" class=\"string\" end-at-line-end=\"true\">\n"
		       "      <start>%s</start><end>%s</end>\n      <include>\n"
		       "        <context id=\"%s-escape\" style-ref=\"escape\">\n"
		       "          <match>\\$([0-9A-F]{2}|.)</match>\n        </context>\n"
		       "      </include>\n    </context>\n", quoted[i][0], quoted[i][1],
		       quoted[i][1], quoted[i][0]);
	printf("    <context id=\"address\" style-ref=\"address\">\n"
	       "      <match>%%\\w[\\w.]*</match>\n    </context>\n"
	       "    <context id=\"literal\" style-ref=\"number\">\n"
	       "      <match>\\b\\w+#(\\w+#)?[+-]?\\w[\\w.:]*(-[0-9][\\w.:]*)*</match>\n    </context>\n"
	       "    <context id=\"number\" style-ref=\"number\">\n"
	       "      <match>\\b[0-9][0-9_]*(\\.[0-9][0-9_]*)?(E[+-]?[0-9]+)?\\b</match>\n"
	       "    </context>\n"
	       "    <context id=\"constant\" style-ref=\"constant\">\n"
	       "      <keyword>TRUE</keyword>\n      <keyword>FALSE</keyword>\n"
	       "    </context>\n");
}

static void st_keywords(void)
{
	static const char *const other[] = {
		"TO", "BY", "VAR_EXTERNAL", "NON_RETAIN", "R_EDGE", "F_EDGE", "RESOURCE", "ON",
		"END_RESOURCE", "TASK", "WITH",
	};

	printf("    <context id=\"keyword\" style-ref=\"keyword\">\n");
	keywords(true);
	for (int i = 0; i < ST_KINDS; i++) {
		const struct st_form *form = st_form((enum st_kind)i);

		if (is_word(form->word))
			printf("      <keyword>%s</keyword>\n", form->word);
		if (is_word(form->end))
			printf("      <keyword>%s</keyword>\n", form->end);
	}
	for (size_t i = 0; i < sizeof(other) / sizeof(other[0]); i++)
		printf("      <keyword>%s</keyword>\n", other[i]);
	printf("    </context>\n    <context id=\"type\" style-ref=\"type\">\n"
	       "      <prefix>(?&lt;!\\.)\\b</prefix>\n"); /* not the member .Time */
	for (int i = 1; i < IEC_TYPE_COUNT; i++)
		printf("      <keyword>%s</keyword>\n", iec_type_row((enum iec_type)i)->word);
	printf("    </context>\n");
}

static void blocks(void)
{
	bool first = true;

	words_of_boxes(&first, WORD_FB);
}

static void functions(void)
{
	bool first = true;

	words_of_boxes(&first, WORD_FN);
	printf("|(?:\\w+_)?TO_\\w+|(?:\\w+_)?TRUNC(?:_\\w+)?");
}

static void structured_text(void)
{
	static const char *const order[] = {
		"block-comment", "pragma", "line-comment", "string", "text", "address", "literal",
		"block", "chart", "chart-end", "body", "keyword", "type", "constant", "function", "number", NULL,
	};

	head("rung-st", "Structured Text", "text/x-iec-st", "*.st;*.iec");
	st_literals();
	match("block", "type", "(?::|\\bOF\\b)\\s*", blocks, "\\b");
	match("chart", "keyword", "^\\s*", heads_of_charts, "\\b(?!\\s*[:(.\\[])");
	match("chart-end", "keyword", "\\b", ends_of_charts, "\\b");
	match("body", "keyword", "^\\s*", words_of_bodies, "\\b(?!\\s*(:=|[(.\\[]))");
	st_keywords();
	match("function", "function", "\\b", functions, "\\b(?=\\s*\\()");
	foot("rung-st", order);
}

int main(int argc, char **argv)
{
	if (argc > 1 && strcmp(argv[1], "st") == 0)
		structured_text();
	else
		rung_files();
	return 0;
}
