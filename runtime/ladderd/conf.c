/* SPDX-License-Identifier: MIT
 *
 * conf - a head, a line for each stored setting, and the CRC-32C of all before:
 *
 *   RUNGCONF 1
 *   period 5ms
 *   crc32c 1f2e3d4c
 */
#include "ladderd/conf.h"

#include "engine/base/digest.h"
#include "engine/base/file.h"
#include "engine/base/literal.h"

#include <errno.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define HEAD      "RUNGCONF 1\n"
#define SUM       "crc32c "
#define SUM_LEN   (sizeof(SUM) - 1 + 9) /* eight digits and the end of the line */
#define FILE_MOST (sizeof(HEAD) + CONF_SETTINGS * (2 * SETTING_TEXT) + SUM_LEN)

enum kind { NUMBER, TIME, NAME };

static const struct row {
	const char *key, *option, *range;
	enum kind kind;
	size_t at;             /* of the member in struct options             */
	bool restart;          /* in force after the next start               */
} rows[CONF_SETTINGS] = {
#define AT(member) offsetof(struct options, member)
	{ "period",        "--period",        "100us to 1m",  TIME,   AT(period_ns), false },
	{ "watchdog",      "--watchdog",      "1 to 1000",    NUMBER, AT(watchdog), false },
	{ "late",          "--late",          "1 to 1000",    NUMBER, AT(late), false },
	{ "rt",            "--rt",            "0 to 49",      NUMBER, AT(priority), true },
	{ "retain-period", "--retain-period", "10ms to 1h",   TIME,   AT(retain.period_ns), true },
	{ "record",        "--record",      "0 to 65536",   NUMBER, AT(record_kb), true },
	{ "name",          "",                "1 to 63 bytes", NAME,  AT(name), false },
#undef AT
};

static bool set_name(struct options *options, const char *value)
{
	const size_t len = strlen(value);

	if (!len || len >= sizeof(options->name))
		return false;
	for (size_t i = 0; i < len; i++)
		if ((unsigned char)value[i] < ' ' || value[i] == 127)
			return false;
	memcpy(options->name, value, len + 1);
	return true;
}

static bool set(struct options *options, const struct row *row, const char *value)
{
	return row->kind == NAME ? set_name(options, value) :
				   options_set(options, row->option, value);
}

/* "" for a value that the command line does not give. */
static void print(const struct options *options, const struct row *row, char *out)
{
	const char *at = (const char *)options + row->at;
	char text[SETTING_TEXT];
	int64_t number;

	if (row->kind == NAME) {
		memcpy(out, at, sizeof(options->name));
		return;
	}
	memcpy(&number, at, sizeof(number));
	literal_print_time(number, text, sizeof(text));
	if (row->kind == NUMBER)
		snprintf(out, SETTING_TEXT, "%lld", (long long)number);
	else
		snprintf(out, SETTING_TEXT, "%s", number ? text + 2 : ""); /* without T# */
}

static void copy(struct options *to, const struct options *from, const struct row *row)
{
	memcpy((char *)to + row->at, (const char *)from + row->at,
	       row->kind == NAME ? sizeof(to->name) : sizeof(int64_t));
}

static const struct row *find(const char *key, size_t len)
{
	for (int i = 0; i < CONF_SETTINGS; i++)
		if (strlen(rows[i].key) == len && memcmp(rows[i].key, key, len) == 0)
			return &rows[i];
	return NULL;
}

/* ---- the file ---- */

static bool path_of(const struct conf *conf, char *out, size_t size)
{
	return snprintf(out, size, "%s/conf", conf->folder) < (int)size;
}

static bool is_whole(const char *text, size_t len)
{
	char sum[SUM_LEN + 1];
	const size_t body = len - SUM_LEN;

	if (len < sizeof(HEAD) - 1 + SUM_LEN || memcmp(text, HEAD, sizeof(HEAD) - 1) != 0)
		return false;
	snprintf(sum, sizeof(sum), SUM "%08x\n", (unsigned)digest_crc32c(0, text, body));
	return memcmp(text + body, sum, SUM_LEN) == 0;
}

/* A line that this version does not know, or whose value it does not take, is left out. */
static void take_line(struct conf *conf, const char *line, size_t len)
{
	const char *space = memchr(line, ' ', len);
	const struct row *row = space ? find(line, (size_t)(space - line)) : NULL;
	char value[SETTING_TEXT];
	size_t value_len;

	if (!row)
		return;
	value_len = (size_t)(line + len - space - 1);
	if (value_len >= sizeof(value))
		return;
	memcpy(value, space + 1, value_len);
	value[value_len] = '\0';
	if (set(&conf->next, row, value))
		memcpy(conf->text[row - rows], value, value_len + 1);
}

static void take_file(struct conf *conf, const char *text, size_t len)
{
	const char *end = text + len - SUM_LEN;

	for (const char *line = text + sizeof(HEAD) - 1; line < end;) {
		const char *stop = memchr(line, '\n', (size_t)(end - line));

		if (!stop)
			return;
		take_line(conf, line, (size_t)(stop - line));
		line = stop + 1;
	}
}

void conf_load(struct conf *conf, struct options *options)
{
	char path[512];
	char *text = NULL;
	size_t len = 0;

	memset(conf, 0, sizeof(*conf));
	conf->folder = options->slots;
	conf->defaults = conf->next = *options;
	if (conf->folder && path_of(conf, path, sizeof(path)) && (access(path, F_OK) == 0 || errno != ENOENT)) {
		text = file_read(path, FILE_MOST, &len, NULL);
		if (!text) /* it may be of the moment */
			text = file_read(path, FILE_MOST, &len, NULL);
		conf->damaged = !text || !is_whole(text, len);
		if (conf->damaged)
			fprintf(stderr, "ladderd: %s is damaged and is not used\n", path);
		else
			take_file(conf, text, len);
	}
	free(text);
	conf->now = conf->next;
	*options = conf->next;
}

static enum refusal save(const struct conf *conf, char *detail, size_t size)
{
	struct diag_list *diags = calloc(1, sizeof(*diags));
	char *text = malloc(FILE_MOST + 1);
	char path[512];
	size_t len = sizeof(HEAD) - 1;
	bool good = false;

	if (diags && text && path_of(conf, path, sizeof(path))) {
		memcpy(text, HEAD, len);
		for (int i = 0; i < CONF_SETTINGS; i++)
			if (*conf->text[i])
				len += (size_t)snprintf(text + len, FILE_MOST - len, "%s %s\n",
							rows[i].key, conf->text[i]);
		len += (size_t)snprintf(text + len, FILE_MOST - len, SUM "%08x\n",
					(unsigned)digest_crc32c(0, text, len));
		diag_init(diags);
		good = file_save(path, text, len, diags);
		if (diags->count)
			snprintf(detail, size, "%s", diags->diag[0].arg);
	}
	free(text);
	free(diags);
	return good ? REFUSAL_NONE : REFUSAL_DISK;
}

/* ---- for the server ---- */

bool conf_get(const struct conf *conf, uint32_t number, struct setting *out)
{
	const struct row *row = &rows[number];

	if (number >= CONF_SETTINGS)
		return false;
	*out = (struct setting){ .key = row->key, .range = row->range, .restart = row->restart,
				 .stored = *conf->text[number] != '\0' };
	print(&conf->now, row, out->now);
	print(&conf->next, row, out->next);
	return true;
}

enum refusal conf_change(struct conf *conf, const char *key, const char *value,
			 struct setting *changed, char *detail, size_t size)
{
	const struct row *row = find(key, strlen(key));
	const struct options before = conf->next;
	char text[SETTING_TEXT];
	char *own = row ? conf->text[row - rows] : text;
	enum refusal refusal;

	snprintf(detail, size, "%.60s" DIAG_AND "%s", key, row ? row->range : "");
	if (!row)
		return REFUSAL_NO_SETTING;
	conf_get(conf, (uint32_t)(row - rows), changed);
	if (!*value)
		copy(&conf->next, &conf->defaults, row);
	else if (strlen(value) >= SETTING_TEXT || !set(&conf->next, row, value)) {
		conf->next = before;
		return REFUSAL_RANGE;
	}
	if (!conf->folder) {
		conf->next = before;
		return REFUSAL_NO_STORE;
	}
	memcpy(text, own, SETTING_TEXT);
	memcpy(own, value, strlen(value) + 1);
	refusal = save(conf, detail, size);
	if (refusal != REFUSAL_NONE) {
		memcpy(own, text, SETTING_TEXT);
		conf->next = before;
	}
	return refusal;
}

void conf_in_force(struct conf *conf)
{
	for (int i = 0; i < CONF_SETTINGS; i++)
		if (!rows[i].restart)
			copy(&conf->now, &conf->next, &rows[i]);
}
