/* SPDX-License-Identifier: MIT
 *
 * classic_say - names of variables from the rows of classic.def.
 */
#include "engine/exchange/classic/classic_say.h"
#include "engine/exchange/classic/classic_convert.h"

#include <stdio.h>
#include <string.h>

static void say_plain(enum classic_dialect dialect, int type, int number, char *out,
		      size_t size)
{
	const struct classic_memory_row *memory;
	const struct classic_pin_row *pin;

	if (dialect == CLASSIC_LINUXCNC && type == LINUXCNC_IN)
		type = LINUXCNC_INPUT;
	memory = classic_memory_of(type);
	pin = classic_pin_of(type);
	if (memory)
		snprintf(out, size, "%%%s%d", memory->prefix, number);
	else if (pin)
		snprintf(out, size, "%%%s%d.%s", pin->prefix, number, pin->attribute);
	else if (type == STEP_TYPE || type == STEP_TIME)
		snprintf(out, size, "%%X%d.%s", number, type == STEP_TYPE ? "A" : "V");
	else
		snprintf(out, size, "?%d/%d", type, number);
}

void classic_say_variable(enum classic_dialect dialect, struct classic_variable variable,
			  char *out)
{
	char base[40], index[40];

	say_plain(dialect, variable.type, variable.number, base, sizeof(base));
	if (variable.index_type < 0) {
		snprintf(out, CLASSIC_SAID, "%s", base);
		return;
	}
	say_plain(dialect, variable.index_type, variable.index_number, index,
		  sizeof(index));
	snprintf(out, CLASSIC_SAID, "%s[%s]", base, index);
}

void classic_say_block(int element, int number, char *out)
{
	static const char *const prefix[] = { "T", "M", "C", "TM", "R" };
	const int at = element - 10;

	snprintf(out, CLASSIC_SAID, "%%%s%d", at >= 0 && at < 5 ? prefix[at] : "?", number);
}

/* ---- expressions ---- */

struct found { struct classic_variable variable; bool is; };

static void take(void *context, struct classic_variable variable)
{
	struct found *found = context;

	if (!found->is)
		found->variable = variable;
	found->is = true;
}

/* The name of the variable "@200/0@" at @text; returns what follows it, NULL: it is none. */
static const char *say_one(enum classic_dialect dialect, const char *text, char *said)
{
	const char *end = strchr(text + 1, '@');
	struct found found = { .is = false };
	char whole[80];

	if (!end || (size_t)(end - text) + 2 > sizeof(whole))
		return NULL;
	memcpy(whole, text, (size_t)(end - text) + 1);
	whole[end - text + 1] = '\0';
	expression_uses(whole, take, &found);
	if (!found.is)
		return NULL;
	classic_say_variable(dialect, found.variable, said);
	return end + 1;
}

void classic_say_expression(enum classic_dialect dialect, const char *text, char *out)
{
	char said[CLASSIC_SAID];
	size_t len = 0;

	while (*text) {
		const char *end = *text == '@' ? say_one(dialect, text, said) : NULL;

		if (!end) {
			said[0] = *text;
			said[1] = '\0';
			end = text + 1;
		}
		if (len + strlen(said) + 1 > CLASSIC_SAID)
			break;
		memcpy(out + len, said, strlen(said));
		len += strlen(said);
		text = end;
	}
	out[len] = '\0';
}

/* ---- symbols ---- */

const char *classic_say_symbol(const struct classic_project *project,
			       const char *variable)
{
	for (int i = 0; i < project->symbols; i++)
		if (strcmp(project->symbol[i].variable, variable) == 0)
			return project->symbol[i].name;
	return "";
}
