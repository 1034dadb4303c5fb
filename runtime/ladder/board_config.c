/* SPDX-License-Identifier: MIT
 *
 * board_config - `ladder board WHERE config`: shows and changes the settings of a board.
 */
#include "ladder/foreign.h"
#include "ladder/remote.h"

#include <stdlib.h>
#include <string.h>

static void print_setting(const struct remote *remote, const struct board_setting *setting,
			  bool first)
{
	const struct sink *out = &remote->call->out;

	if (remote->json) {
		sink_text(out, first ? "\n  {\"key\": " : ",\n  {\"key\": ");
		sink_json_text(out, setting->key);
		report_json_field("value", setting->now, out);
		report_json_field("next", setting->next, out);
		report_json_field("range", setting->range, out);
		sink_text(out, setting->stored ? ", \"stored\": true" : ", \"stored\": false");
		sink_text(out, setting->restart ? ", \"restart\": true}" : ", \"restart\": false}");
		return;
	}
	foreign_text(out, setting->key);
	sink_text(out, "=");
	foreign_text(out, setting->now);
	if (strcmp(setting->now, setting->next) != 0) {
		sink_text(out, ", after a restart ");
		foreign_text(out, *setting->next ? setting->next : "the default");
	}
	sink_text(out, setting->stored ? "\n" : " (default)\n");
}

enum status remote_settings(struct remote *remote, struct board_settings *settings)
{
	struct wire_writer out = desk_ask(&remote->desk, SERVICE_CONFIG);
	struct wire_reader in;
	enum desk_end end;

	wire_put_u8(&out, 0);
	end = desk_call(&remote->desk, &out, &in);
	if (end != DESK_GOOD)
		return remote_fail(remote, end);
	settings->count = wire_u16(&in);
	if (settings->count > REMOTE_SETTINGS)
		settings->count = REMOTE_SETTINGS;
	for (int i = 0; i < settings->count; i++) {
		struct board_setting *setting = &settings->at[i];
		uint8_t flags;

		wire_copy_text(&in, setting->key, sizeof(setting->key));
		wire_copy_text(&in, setting->now, sizeof(setting->now));
		wire_copy_text(&in, setting->next, sizeof(setting->next));
		flags = wire_u8(&in);
		setting->stored = flags & 1;
		setting->restart = flags & 2;
		wire_copy_text(&in, setting->range, sizeof(setting->range));
	}
	return in.failed ? remote_fail(remote, DESK_NONSENSE) : STATUS_GOOD;
}

enum status remote_set(struct remote *remote, const char *key, const char *value, bool restart,
		       bool *needs_restart)
{
	struct wire_writer out = desk_ask(&remote->desk, SERVICE_CONFIG);
	struct wire_reader in;
	enum desk_end end;

	wire_put_u8(&out, 1);
	wire_put_expect(&out, &remote->expect);
	wire_put_u8(&out, restart);
	wire_put_string(&out, key);
	wire_put_string(&out, value);
	end = desk_call(&remote->desk, &out, &in);
	if (end != DESK_GOOD)
		return remote_fail(remote, end);
	*needs_restart = wire_u8(&in);
	return in.failed ? remote_fail(remote, DESK_NONSENSE) : STATUS_GOOD;
}

static enum status show(struct remote *remote, const char *key)
{
	struct board_settings settings;
	enum status status = remote_settings(remote, &settings);
	bool any = false;

	if (status != STATUS_GOOD)
		return status;
	if (remote->json)
		sink_text(&remote->call->out, "[");
	for (int i = 0; i < settings.count; i++) {
		if (key && strcmp(key, settings.at[i].key) != 0)
			continue;
		print_setting(remote, &settings.at[i], !any);
		any = true;
	}
	if (remote->json)
		sink_text(&remote->call->out, "\n]\n");
	if (any || !key)
		return STATUS_GOOD;
	report_diag((struct diag){ .id = DIAG_LINK_NO_SETTING, .file = remote->where }, "%.40s", key);
	return STATUS_NO;
}

enum status remote_config(struct remote *remote)
{
	const struct call *call = remote->call;
	const bool restart = call_flag(call, "--restart");
	bool needs_restart = false;
	enum status status;

	if (call->arg_count > 4)
		return report_usage(call, "config takes KEY and VALUE");
	if (call->arg_count < 4)
		return show(remote, call->arg_count == 3 ? call->arg[2] : NULL);
	status = remote_expect(remote, false);
	if (status == STATUS_GOOD)
		status = remote_set(remote, call->arg[2], call->arg[3], restart, &needs_restart);
	if (status == STATUS_GOOD && needs_restart && !restart)
		sink_printf(&call->out, "%.40s is stored; it needs a restart of the board "
			    "(--restart)\n", call->arg[2]);
	return status;
}
