/* SPDX-License-Identifier: MIT
 *
 * board_password - `ladder board WHERE password`: sets, changes or removes the program password;
 * and asks for it where a program is read.
 */
#include "ladder/remote.h"
#include "ladder/secret.h"

#include <string.h>

/* @state: 0 none, 1 set. */
static enum status ask_state(struct remote *remote, uint8_t *state)
{
	struct wire_writer out = desk_ask(&remote->desk, SERVICE_PASSWORD);
	struct wire_reader in;
	enum desk_end end;

	wire_put_u8(&out, 2);
	end = desk_call(&remote->desk, &out, &in);
	if (end != DESK_GOOD)
		return remote_fail(remote, end);
	*state = wire_u8(&in);
	return in.failed ? remote_fail(remote, DESK_NONSENSE) : STATUS_GOOD;
}

/* Nothing of a request stays in the buffer of the desk. */
static enum status send(struct remote *remote, struct wire_writer *out)
{
	const size_t len = wire_len(out);
	struct wire_reader in;
	const enum desk_end end = desk_call(&remote->desk, out, &in);

	secret_wipe(remote->desk.out, len);
	return end == DESK_GOOD ? STATUS_GOOD : remote_fail(remote, end);
}

enum status remote_unlock(struct remote *remote)
{
	char text[SECRET_MOST];
	struct wire_writer out;
	enum status status = secret_read(remote->call, "Program password of the board", text);

	if (status == STATUS_GOOD) {
		out = desk_ask(&remote->desk, SERVICE_PASSWORD);
		wire_put_u8(&out, 0);
		wire_put_string(&out, text);
		status = send(remote, &out);
	}
	secret_wipe(text, sizeof(text));
	return status;
}

static enum status ask_new(struct remote *remote, char *text)
{
	char again[SECRET_MOST] = "";
	enum status status = secret_read(remote->call, "New program password", text);

	if (status == STATUS_GOOD && !call_option(remote->call, "--password-fd")) {
		status = secret_read(remote->call, "The same again", again);
		if (status == STATUS_GOOD && strcmp(text, again) != 0)
			status = remote_tell(remote, DIAG_NOT_TWICE);
	}
	secret_wipe(again, sizeof(again));
	return status;
}

enum status remote_password(struct remote *remote)
{
	const struct sink *sink = &remote->call->out;
	const bool remove = call_flag(remote->call, "--remove");
	char old[SECRET_MOST] = "", text[SECRET_MOST] = "";
	struct wire_writer out;
	uint8_t state = 0;
	enum status status = ask_state(remote, &state);

	if (status == STATUS_GOOD && remote->json) {
		sink_text(sink, state ? "{\"password\": true}\n" : "{\"password\": false}\n");
		return STATUS_GOOD;
	}
	if (status == STATUS_GOOD && state)
		status = secret_read(remote->call, "Present program password", old);
	if (status == STATUS_GOOD && !remove)
		status = ask_new(remote, text);
	if (status == STATUS_GOOD)
		status = remote_expect(remote, false);
	if (status == STATUS_GOOD) {
		out = desk_ask(&remote->desk, SERVICE_PASSWORD);
		wire_put_u8(&out, 1);
		wire_put_expect(&out, &remote->expect);
		wire_put_string(&out, old);
		wire_put_string(&out, text);
		status = send(remote, &out);
	}
	secret_wipe(old, sizeof(old));
	secret_wipe(text, sizeof(text));
	if (status == STATUS_GOOD)
		sink_text(sink, remove ? "the program password is removed\n" :
				state ? "the program password is changed\n" : "the program password is set\n");
	return status;
}
