/* SPDX-License-Identifier: MIT
 *
 * serve_board - who is there, status, mode, settings, the program password.
 */
#include "online/serve.h"

#include "engine/base/version.h"

#include <stdio.h>
#include <string.h>

enum refusal serve_hello(struct asked *asked)
{
	struct wire_reader *in = &asked->frame.body;
	const uint32_t magic = wire_u32(in);
	const uint16_t lowest = wire_u16(in), highest = wire_u16(in);
	size_t len;

	wire_text(in, &len); /* the name of the desk's program */
	if (in->failed || magic != ONLINE_MAGIC)
		return REFUSAL_BAD_FRAME;
	snprintf(asked->detail, sizeof(asked->detail), "desk %u to %u, board %u to %u",
		 (unsigned)lowest, (unsigned)highest, ONLINE_LOWEST, ONLINE_HIGHEST);
	if (lowest > ONLINE_HIGHEST || highest < ONLINE_LOWEST)
		return REFUSAL_VERSION;
	/* A board may have more fields than a desk of before, and a desk more than a board. */
	if (wire_left(in) && wire_u8(in) == ROLE_IO && asked->session->may_io)
		asked->session->role = ROLE_IO;
	asked->session->greeted = true;
	asked_begin(asked, 0);
	wire_put_u32(&asked->out, ONLINE_MAGIC);
	wire_put_u16(&asked->out, highest < ONLINE_HIGHEST ? highest : ONLINE_HIGHEST);
	wire_put_u8(&asked->out, (uint8_t)asked->session->role);
	wire_put_u8(&asked->out, (uint8_t)(asked->session - asked->server->session));
	wire_put_string(&asked->out, LADDER_VERSION);
	wire_put_string(&asked->out, *asked->server->setup.board);
	return REFUSAL_NONE;
}

static enum refusal learn_status(struct server *server)
{
	enum refusal refusal;

	if (!server_can_order(server))
		return REFUSAL_BUSY;
	server->order = (struct order){ .kind = ORDER_STATUS, .status = &server->status };
	refusal = server_give_unless_hung(server);
	if (refusal == REFUSAL_NONE)
		server->known = server->status;
	return refusal;
}

/* A scan that hangs gives no values: the answer has the last ones, and says that it hangs. */
static bool is_hung(struct server *server)
{
	if (!server_hangs(server) || !*server->known.version)
		return false;
	server->known.mode = STATE_FAULT;
	snprintf(server->known.fault, sizeof(server->known.fault), "watchdog: a scan hangs and does not end");
	return true;
}

enum refusal serve_status(struct asked *asked)
{
	struct server *server = asked->server;
	const enum refusal refusal = learn_status(server);

	if (refusal != REFUSAL_NONE && !(refusal == REFUSAL_BUSY && is_hung(server)))
		return refusal;
	server->setup.amend(server->setup.context, &server->known);
	server->known.sessions = (uint32_t)server_sessions(server);
	asked_begin(asked, 0);
	status_put(&asked->out, &server->known);
	gateways_put(&asked->out, io_status(server));
	values_put(&asked->out, io_values(server));
	return REFUSAL_NONE;
}

enum refusal serve_mode(struct asked *asked)
{
	struct server *server = asked->server;
	struct wire_reader *in = &asked->frame.body;
	const struct expect expect = wire_expect(in);
	const enum mode_wish wish = (enum mode_wish)wire_u8(in);
	static const char *const word[MODE_COUNT] = { "STOP", "RUN", "RUN, cold", "reset" };
	enum refusal refusal;

	if (!wire_done(in) || wish >= MODE_COUNT)
		return REFUSAL_BAD_FRAME;
	if (wish != MODE_RESET && asked->session->role < ROLE_ENG)
		return asked_refuse_role(asked, ROLE_ENG);
	if (!server_can_order(server))
		return REFUSAL_BUSY;
	server->order = (struct order){ .kind = ORDER_MODE, .mode = wish,
					.expects = true, .expect = expect };
	refusal = asked_finish(asked);
	if (refusal == REFUSAL_NONE)
		asked_tell(asked, EVENT_MODE, word[wish], "");
	return refusal;
}

static enum refusal put_settings(struct asked *asked)
{
	const struct server_setup *setup = &asked->server->setup;
	struct setting setting;
	uint16_t count = 0;
	uint8_t *head;

	asked_begin(asked, 0);
	head = asked->out.at;
	wire_put_u16(&asked->out, 0);
	for (; setup->conf->get(setup->context, count, &setting); count++) {
		wire_put_string(&asked->out, setting.key);
		wire_put_string(&asked->out, setting.now);
		wire_put_string(&asked->out, setting.next);
		wire_put_u8(&asked->out, (uint8_t)(setting.stored | setting.restart << 1));
		wire_put_string(&asked->out, setting.range);
	}
	head[0] = (uint8_t)count;
	return REFUSAL_NONE;
}

/* Nothing is written for a desk that is stale. */
static enum refusal expected(struct server *server, const struct expect *expect)
{
	if (!server_can_order(server))
		return REFUSAL_BUSY;
	server->order = (struct order){ .kind = ORDER_STATUS, .status = &server->status,
					.expects = true, .expect = *expect };
	return server_give(server);
}

static enum refusal change_setting(struct asked *asked)
{
	struct server *server = asked->server;
	struct wire_reader *in = &asked->frame.body;
	const struct expect expect = wire_expect(in);
	const uint8_t how = wire_u8(in);
	char key[32], value[SETTING_TEXT + 1], told[80];
	struct setting changed;
	enum refusal refusal;

	wire_copy_text(in, key, sizeof(key));
	wire_copy_text(in, value, sizeof(value));
	if (!wire_done(in) || how > 1)
		return REFUSAL_BAD_FRAME;
	refusal = expected(server, &expect);
	if (refusal == REFUSAL_NONE)
		refusal = server->setup.conf->change(server->setup.context, key, value, &changed,
						     asked->detail, sizeof(asked->detail));
	if (refusal != REFUSAL_NONE)
		return refusal;
	snprintf(told, sizeof(told), "%.15s=%.63s", key, value);
	asked_tell(asked, EVENT_CONFIG, told, changed.next);
	if (how == 1) {
		server->order = server_restart(&expect, false);
		refusal = server_give(server);
	}
	if (refusal != REFUSAL_NONE)
		return refusal;
	asked_begin(asked, 0);
	wire_put_u8(&asked->out, changed.restart);
	return REFUSAL_NONE;
}

enum refusal serve_config(struct asked *asked)
{
	const uint8_t what = wire_u8(&asked->frame.body);

	if (!asked->server->setup.conf)
		return REFUSAL_NO_SERVICE;
	if (what == 0 && wire_done(&asked->frame.body))
		return put_settings(asked);
	return what == 1 ? change_setting(asked) : REFUSAL_BAD_FRAME;
}

static void tell_time(const struct asked *asked, int64_t from_ns, int64_t to_ns)
{
	char from[20], to[20];

	board_time_print(from_ns, 0, from);
	board_time_print(to_ns, 0, to);
	asked_tell(asked, EVENT_TIME_SET, from, to);
}

static enum refusal set_time(struct asked *asked, int64_t time_ns, bool anyway)
{
	const struct server_setup *setup = &asked->server->setup;
	struct board_time before;
	enum refusal refusal;

	if (asked->session->role < ROLE_ENG)
		return asked_refuse_role(asked, ROLE_ENG);
	snprintf(asked->detail, sizeof(asked->detail), "time" DIAG_AND "a time from 2000 to 2099");
	if (time_ns < BOARD_TIME_LEAST || time_ns >= BOARD_TIME_END)
		return REFUSAL_RANGE;
	setup->clock->read(setup->context, 0, &before);
	if (before.sync == SYNC_YES && !anyway)
		return REFUSAL_TIME_KEPT;
	refusal = setup->clock->set(setup->context, time_ns);
	if (refusal == REFUSAL_NONE)
		tell_time(asked, before.time_ns, time_ns);
	return refusal;
}

/* Nothing in the program runs by this clock, so a change expects no mode and no program. */
enum refusal serve_time(struct asked *asked)
{
	const struct server_setup *setup = &asked->server->setup;
	struct wire_reader *in = &asked->frame.body;
	const uint8_t what = wire_u8(in);
	const int64_t time_ns = wire_i64(in);
	enum refusal refusal = REFUSAL_NONE;
	struct board_time now;

	if (!wire_done(in) || what > 2)
		return REFUSAL_BAD_FRAME;
	if (!setup->clock)
		return REFUSAL_NO_SERVICE;
	if (what)
		refusal = set_time(asked, time_ns, what == 2);
	if (refusal != REFUSAL_NONE)
		return refusal;
	setup->clock->read(setup->context, what ? 0 : time_ns, &now);
	asked_begin(asked, 0);
	board_time_put(&asked->out, &now);
	return REFUSAL_NONE;
}

#define PASSWORD_TEXT 129

static void wipe(void *bytes, size_t len)
{
	volatile uint8_t *at = bytes;

	while (len--)
		*at++ = 0;
}

static void take_password(struct wire_reader *in, char *out)
{
	size_t len;
	const char *text = wire_text(in, &len);

	if (len >= PASSWORD_TEXT || memchr(text, 0, len)) {
		in->failed = true;
		len = 0;
	}
	memcpy(out, text, len);
	out[len] = '\0';
}

/* Who guesses is in the log. */
static enum refusal told_wrong(struct asked *asked, enum refusal refusal)
{
	if (refusal == REFUSAL_WRONG)
		asked_tell(asked, EVENT_WRONG, "", "");
	return refusal;
}

static enum refusal give_password(struct asked *asked, char *text)
{
	const struct server_setup *setup = &asked->server->setup;
	enum refusal refusal;

	take_password(&asked->frame.body, text);
	if (!wire_done(&asked->frame.body))
		return REFUSAL_BAD_FRAME;
	refusal = setup->password->check(setup->context, asked->session->who, text, asked->detail,
					 sizeof(asked->detail));
	if (refusal != REFUSAL_NONE)
		return told_wrong(asked, refusal);
	asked->session->unlocked = true;
	asked_begin(asked, 0);
	return REFUSAL_NONE;
}

/* Other sessions must give the new one. */
static enum refusal change_password(struct asked *asked, char *old, char *text)
{
	struct server *server = asked->server;
	const struct server_setup *setup = &server->setup;
	const bool was_set = setup->password->is_set(setup->context);
	const struct expect expect = wire_expect(&asked->frame.body);
	enum refusal refusal;

	take_password(&asked->frame.body, old);
	take_password(&asked->frame.body, text);
	if (!wire_done(&asked->frame.body))
		return REFUSAL_BAD_FRAME;
	refusal = expected(server, &expect);
	if (refusal == REFUSAL_NONE)
		refusal = setup->password->change(setup->context, asked->session->who, old, text,
						  asked->detail, sizeof(asked->detail));
	if (refusal != REFUSAL_NONE)
		return told_wrong(asked, refusal);
	for (int i = 0; i < SERVER_SESSIONS; i++)
		server->session[i].unlocked = false;
	asked_tell(asked, EVENT_PASSWORD, !*text ? "removed" : was_set ? "changed" : "set", "");
	asked_begin(asked, 0);
	return REFUSAL_NONE;
}

enum refusal serve_password(struct asked *asked)
{
	const struct server_setup *setup = &asked->server->setup;
	char old[PASSWORD_TEXT], text[PASSWORD_TEXT];
	enum refusal refusal = REFUSAL_BAD_FRAME;
	const uint8_t what = wire_u8(&asked->frame.body);

	if (!setup->password)
		return REFUSAL_NO_SERVICE;
	if (what == 0)
		refusal = give_password(asked, text);
	else if (what == 1 && asked->session->role < ROLE_ENG)
		refusal = asked_refuse_role(asked, ROLE_ENG);
	else if (what == 1)
		refusal = change_password(asked, old, text);
	else if (what == 2 && wire_done(&asked->frame.body)) {
		asked_begin(asked, 0);
		wire_put_u8(&asked->out, setup->password->is_set(setup->context));
		refusal = REFUSAL_NONE;
	}
	wipe(old, sizeof(old));
	wipe(text, sizeof(text));
	return refusal;
}
