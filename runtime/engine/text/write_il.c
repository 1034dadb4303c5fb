/* SPDX-License-Identifier: MIT
 *
 * write_il - an instruction list as text that reads again to the same list.
 *
 * One instruction a line, labels and lone comments at its beginning, calls whole on one
 * line.
 */
#include "engine/text/writer.h"

#include "engine/text/text.h"

#include <string.h>

static bool is_arg(const struct il_line *line)
{
	return line->kind == IL_ARG_IN || line->kind == IL_ARG_OUT ||
	       line->kind == IL_TARGET;
}

/* Operands stand in a column of their own. */
static void write_padded(const struct sink *sink, const char *word,
			 const char *modifier)
{
	const int len = (int)(strlen(word) + strlen(modifier));

	sink_text(sink, word);
	sink_text(sink, modifier);
	sink_repeat(sink, " ", len < 5 ? 6 - len : 1);
}

/* `&Name`, where a variable is, and `@Name`, where a reference leads, are REF(Name). */
static void write_operand(const struct sink *sink, const struct project *project, uint32_t operand)
{
	const char *text = project_text(project, operand);
	const bool place = *text == '&' || *text == '@';

	if (!place) {
		write_id(sink, project, operand);
		return;
	}
	sink_text(sink, "REF(");
	sink_text(sink, text + 1);
	sink_text(sink, ")");
}

static void write_args(const struct sink *sink, const struct project *project,
		       const struct il_line *arg, int count)
{
	sink_text(sink, "(");
	for (int i = 0; i < count; i++) {
		sink_text(sink, i > 0 ? ", " : "");
		if (!(arg[i].mark & IL_IN_ORDER)) {
			write_id(sink, project, arg[i].pin);
			sink_text(sink, arg[i].kind == IL_ARG_OUT ? " => " : " := ");
		}
		write_operand(sink, project, arg[i].operand);
	}
	sink_text(sink, ")");
}

static void write_operator(const struct sink *sink, const struct project *project,
			   const struct il_line *line)
{
	const char *word = op_row((enum op)line->op)->word;
	const char *modifier = "";

	if ((line->modifiers & MOD_C) && (line->modifiers & MOD_N))
		modifier = "CN";
	else if (line->modifiers & MOD_C)
		modifier = "C";
	else if (line->modifiers & MOD_N)
		modifier = "N";
	if (line->operand && !(line->modifiers & MOD_PAREN)) {
		write_padded(sink, word, modifier);
		write_operand(sink, project, line->operand);
		return;
	}
	sink_text(sink, word);
	sink_text(sink, modifier);
	if (line->modifiers & MOD_PAREN)
		sink_text(sink, "(");
	/* AND( may stand with its first operand, as in the standard. */
	if (line->operand) {
		sink_text(sink, " ");
		write_operand(sink, project, line->operand);
	}
}

static void write_each(const struct sink *sink, const struct project *project,
		       const struct il_line *line, int targets)
{
	sink_text(sink, "  EACH  ");
	write_id(sink, project, line->operand);
	sink_text(sink, "(");
	for (int i = 1; i <= targets; i++) {
		sink_text(sink, i > 1 ? ", " : "");
		write_id(sink, project, line[i].operand);
	}
	sink_text(sink, ")");
}

static void write_line(const struct sink *sink, const struct project *project,
		       const struct il_line *line, int args)
{
	const char *word = words_row(&project->words, (enum word)line->word)->word;

	switch ((enum il_kind)line->kind) {
	case IL_OP:
		sink_text(sink, "  ");
		write_operator(sink, project, line);
		if (args > 0)
			write_args(sink, project, line + 1, args);
		return;
	case IL_FN:
		sink_text(sink, "  ");
		if (line->modifiers & MOD_PAREN) {
			sink_text(sink, word);
			sink_text(sink, line->operand ? "( " : "(");
			write_operand(sink, project, line->operand);
			return;
		}
		if (!line->operand) {
			sink_text(sink, word);
			return;
		}
		write_padded(sink, word, "");
		write_operand(sink, project, line->operand);
		for (int i = 1; i <= args; i++) {
			sink_text(sink, ", ");
			write_operand(sink, project, line[i].operand);
		}
		return;
	case IL_CALL:
		sink_text(sink, "  ");
		sink_text(sink, word);
		write_args(sink, project, line + 1, args);
		return;
	case IL_CLOSE:
		sink_text(sink, "  )");
		return;
	case IL_LABEL:
		write_id(sink, project, line->operand);
		sink_text(sink, ":");
		return;
	case IL_COMMENT:
		write_comments(sink, project, line->operand);
		return;
	case IL_EACH:
		write_each(sink, project, line, args);
		return;
	case IL_TICK:
		sink_text(sink, "  TICK  ");
		write_id(sink, project, line->operand);
		write_args(sink, project, line + 1, args);
		return;
	case IL_TARGET:
	case IL_ARG_IN:
	case IL_ARG_OUT:
		return;
	}
}

void text_write_il(const struct project *project, const struct il *il,
		   const struct sink *sink)
{
	uint32_t last = 0; /* source line of the instruction before           */

	for (int i = 0; i < il->count; i++) {
		const struct il_line *line = &il->line[i];
		int args = 0;

		while (i + 1 < il->count && is_arg(&il->line[i + 1])) {
			args++;
			i++;
		}
		/* A comment after an instruction has the same line. */
		if (line->kind == IL_COMMENT && last && line->line == last)
			sink_text(sink, " ");
		else if (line != il->line)
			sink_text(sink, "\n");
		if (line->kind != IL_COMMENT)
			last = line->line;
		write_line(sink, project, line, args);
	}
	if (il->count > 0)
		sink_text(sink, "\n");
}
