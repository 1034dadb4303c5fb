/* SPDX-License-Identifier: MIT
 *
 * usage - what ladder-editor prints on a terminal; see usage.h.
 */
#include "editor-gtk/window/usage.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/verbs.h"

#include "engine/base/version.h"

#include <stdio.h>
#include <string.h>

/* ---- the texts ---- */

static const char *help_text(void)
{
	return _("usage: ladder-editor [FILE]...\n"
		 "       ladder-editor --compare OLD NEW\n"
		 "       ladder-editor --render FILE [OPTION]... -o PICTURE\n"
		 "\n"
		 "Draws, checks, saves and prints ladder programs. Each file gets a window; without\n"
		 "one there is a page with samples. What was not saved before a crash comes back.\n"
		 "\n"
		 "  --compare        shows what differs between two files\n"
		 "  --keys [SCHEME]  what each key does; SCHEME: rungboard, micro/win, gx works,\n"
		 "                   ldmicro\n"
		 "  --render         draws into a file, without a display: --render --help\n"
		 "  --version        the version\n"
		 "  --help           this text\n"
		 "\n"
		 "Exit status: 0; 1 if the window could not be opened; 2 if the command line is\n"
		 "wrong. A file that cannot be read is told in the window.\n");
}

static int width_of(const char *text)
{
	return (int)g_utf8_strlen(text, -1);
}

static char *all_labels(const char *keys)
{
	char **each = g_strsplit(keys, "|", -1);
	GString *text = g_string_new(NULL);

	for (char **key = each; *key; key++) {
		char *label = keys_label(*key);

		/* keys of the number pad are the same again */
		if (label[0] && !strstr(*key, "KP_"))
			g_string_append_printf(text, "%s%s", text->len ? ", " : "", label);
		g_free(label);
	}
	g_strfreev(each);
	return g_string_free(text, FALSE);
}

static void print_key(const char *keys, const char *label)
{
	char *text = all_labels(keys);

	if (text[0])
		printf("  %s%*s%s\n", text, MAX(26 - width_of(text), 2), "", label);
	g_free(text);
}

static void print_keys(enum key_scheme scheme)
{
	const char *word, *keys;

	for (int group = 0; group < VERBS_GROUPS; group++) {
		printf("%s%s\n", group ? "\n" : "", _(verb_group_label((enum verb_group)group)));
		for (int i = 0; i < VERB_COUNT; i++) {
			char *of = verb_keys_of((enum verb)i, scheme);

			if ((int)verb_row((enum verb)i)->group == group)
				print_key(of, _(verb_row((enum verb)i)->label));
			g_free(of);
		}
	}
	for (int i = 0; key_scheme_put(scheme, i, &word, &keys); i++) {
		if (i == 0)
			printf("\n%s\n", _("Elements"));
		print_key(keys, word);
	}
}

/* ---- the man page ---- */

/* Prints @text for a man page, so that no line of it is a request. */
static void print_plain(const char *text)
{
	bool begins = true;

	for (; *text; begins = *text++ == '\n') {
		if (begins && (*text == '.' || *text == '\''))
			fputs("\\&", stdout);
		if (*text == '\\')
			fputs("\\e", stdout);
		else if (*text == '-')
			fputs("\\-", stdout);
		else
			putchar(*text);
	}
}

static void man_group(enum verb_group group)
{
	bool first = true;

	for (int i = 0; i < VERB_COUNT; i++) {
		const struct verb_row *row = verb_row((enum verb)i);
		char *keys = row->group == group ? all_labels(row->keys) : g_strdup("");

		if (keys[0]) {
			if (first)
				printf(".SS %s\n", verb_group_label(group));
			first = false;
			printf(".TP\n.B ");
			print_plain(keys);
			putchar('\n');
			print_plain(row->label);
			putchar('\n');
		}
		g_free(keys);
	}
}

static void print_man(void)
{
	printf(".TH LADDER\\-EDITOR 1 \"\" \"Rungboard %s\" \"Rungboard\"\n"
	       ".SH NAME\nladder\\-editor \\- draws, checks and prints ladder programs\n"
	       ".SH SYNOPSIS\n.B ladder\\-editor\n[\\fIFILE\\fR]...\n.br\n"
	       ".B ladder\\-editor \\-\\-compare\n\\fIOLD\\fR \\fINEW\\fR\n.br\n"
	       ".B ladder\\-editor \\-\\-render\n\\fIFILE\\fR [\\fIOPTION\\fR]... "
	       "\\fB\\-o\\fR \\fIPICTURE\\fR\n.SH DESCRIPTION\n.nf\n", LADDER_VERSION);
	print_plain(strstr(help_text(), "\n\n") + 2);
	printf(".fi\n.SH KEYS\nOf the scheme Rungboard; Preferences in the window has others.\n");
	for (int i = 0; i < VERBS_GROUPS; i++)
		man_group((enum verb_group)i);
	printf(".SH FILES\n.TP\n.I ~/.local/state/rungboard/\n"
	       "drafts of what is not saved yet\n"
	       ".SH SEE ALSO\n.BR ladder (1),\n.BR ladderd (8)\n");
}

/* ---- the command line ---- */

static int keys_main(const char *name)
{
	for (int i = 0; i < KEY_SCHEMES; i++)
		if (!name || g_ascii_strcasecmp(name, key_scheme_name((enum key_scheme)i)) == 0) {
			print_keys((enum key_scheme)i);
			return 0;
		}
	fprintf(stderr, _("ladder-editor: “%.40s” is not a key scheme; see "
			  "ladder-editor --help\n"), name);
	return 2;
}

static bool is_known(const char *option)
{
	/* options of GApplication and GTK */
	static const char *const known[] = { "--gapplication-", "--display", "--name",
					     "--class", "--g-fatal-warnings" };

	if (option[0] != '-' || !option[1])
		return true;
	for (gsize i = 0; i < G_N_ELEMENTS(known); i++)
		if (g_str_has_prefix(option, known[i]))
			return true;
	return false;
}

bool usage_compares(int argc, char **argv)
{
	return argc == 4 && strcmp(argv[1], "--compare") == 0 && argv[2][0] != '-' &&
	       argv[3][0] != '-';
}

bool usage_main(int argc, char **argv, int *status)
{
	*status = 0;
	if (usage_compares(argc, argv))
		return false;
	for (int i = 1; i < argc; i++) {
		if (strcmp(argv[i], "--") == 0)
			return false;
		if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) {
			fputs(help_text(), stdout);
		} else if (strcmp(argv[i], "--version") == 0) {
			printf("ladder-editor %s\n", LADDER_VERSION);
		} else if (strcmp(argv[i], "--keys") == 0) {
			*status = keys_main(argv[i + 1]);
		} else if (strcmp(argv[i], "--man") == 0) {
			print_man();
		} else if (strcmp(argv[i], "--compare") == 0) {
			fputs(_("ladder-editor: --compare needs two files, and nothing else\n"),
			      stderr);
			*status = 2;
		} else if (!is_known(argv[i])) {
			fprintf(stderr, _("ladder-editor: “%.24s” is not an option; see "
					  "ladder-editor --help\n"), argv[i]);
			*status = 2;
		} else {
			continue;
		}
		return true;
	}
	return false;
}
