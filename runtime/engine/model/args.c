/* SPDX-License-Identifier: MIT
 *
 * args - splits the text of the parameters at a box.
 *
 * Reads the canonical text that the readers keep; blanks around := and => are allowed.
 * A malformed parameter ends the list: the readers have reported it.
 */
#include "engine/model/args.h"
#include "engine/base/name.h"

static const char *skip_blanks(const char *at)
{
	while (*at == ' ' || *at == '\t')
		at++;
	return at;
}

/* Up to the next blank outside of quotes: 'a $'b'. */
static const char *skip_value(const char *at)
{
	bool quoted = false;

	for (; *at && (quoted || (*at != ' ' && *at != '\t')); at++) {
		if (*at == '\'')
			quoted = !quoted;
		else if (*at == '$' && quoted && at[1])
			at++;
	}
	return at;
}

bool args_next(const char **at, struct arg *out)
{
	const char *text = skip_blanks(*at);

	out->pin = text;
	while (*text && *text != ' ' && *text != ':' && *text != '=')
		text++;
	out->pin_len = (size_t)(text - out->pin);
	text = skip_blanks(text);
	out->output = text[0] == '=' && text[1] == '>';
	if (out->pin_len == 0 ||
	    (!out->output && (text[0] != ':' || text[1] != '=')))
		return false;
	text = skip_blanks(text + 2);
	out->inverse = !out->output && *text == '/';
	text += out->inverse;
	out->value = text;
	text = skip_value(text);
	out->value_len = (size_t)(text - out->value);
	if (out->value_len == 0)
		return false;
	*at = text;
	return true;
}

bool args_find(const char *text, const char *pin, size_t pin_len,
	       struct arg *out)
{
	while (args_next(&text, out))
		if (name_same(out->pin, out->pin_len, pin, pin_len))
			return true;
	return false;
}

bool args_find_side(const char *text, bool output, const char *pin, size_t pin_len,
		    struct arg *out)
{
	while (args_next(&text, out))
		if (out->output == output && name_same(out->pin, out->pin_len, pin, pin_len))
			return true;
	return false;
}
