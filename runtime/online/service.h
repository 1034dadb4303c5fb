/* SPDX-License-Identifier: MIT
 *
 * service - the words of the protocol: services, roles, refusals, modes, and the fields that
 * several services share.
 *
 * Both sides use it. It knows neither a program nor a stream.
 */
#ifndef ONLINE_SERVICE_H
#define ONLINE_SERVICE_H

#include "engine/base/iec.h"
#include "online/wire.h"

#define ONLINE_MAGIC   0x474e5552u /* "RUNG"                                  */
#define ONLINE_LOWEST  1u          /* versions of the protocol that are spoken */
#define ONLINE_HIGHEST 1u

/* In this order: each may do what those before it may. IO, of gateways, is beside them. */
enum role {
	ROLE_NONE, ROLE_VIEW, ROLE_OPER, ROLE_ENG,
#ifndef RUNGBOARD_SMALL
	ROLE_IO,
#endif
	ROLE_COUNT
};
#define ROLE_PERSONS (ROLE_ENG + 1) /* those before it are of persons         */
/** role_word - "view"; "none". Static. */
const char *role_word(enum role role);

/* The programs that serve points of an I/O map, each those of its drivers. */
enum gateway_id { GATEWAY_MODBUS, GATEWAY_PEER, GATEWAY_COUNT };
/** gateway_word - "modbus". Static. */
const char *gateway_word(enum gateway_id gateway);

enum service {
#define SERVICE(id, number, word, role, limit_ms) SERVICE_##id = (number),
#include "online/services.def"
};
struct service_row {
	uint8_t number;
	const char *word;
	enum role role;
	int limit_ms;
};
/** service_row - NULL: no service has this number. Static. */
const struct service_row *service_row(uint8_t number);

enum refusal {
	REFUSAL_NONE,
#define REFUSAL(id, number) REFUSAL_##id = (number),
#include "online/refusals.def"
};
/** refusal_diag - its row of diag.def; DIAG_LINK_REFUSED: no refusal has this number. */
enum diag_id refusal_diag(uint16_t number);
/** mode_word - "RUN" of an enum resource_state; "unknown". Static. */
const char *mode_word(uint8_t mode);

/* What the service `mode` is asked for. WARM and COLD start from STOP, with retained values or
 * with initial ones; RESET starts warm from FAULT. */
enum mode_wish { MODE_STOP, MODE_WARM, MODE_COLD, MODE_RESET, MODE_COUNT };
/** mode_wish_word - "stop", "run", "reset". Static. Scan-safe: yes; so is mode_wish_needs(). */
const char *mode_wish_word(enum mode_wish wish);
/** mode_wish_needs - the mode, enum resource_state, in which it is possible. */
uint8_t mode_wish_needs(enum mode_wish wish);

/* What a download ends with. STOPPED: a restart in STOP. */
enum commit_how { COMMIT_LIVE, COMMIT_RESTART, COMMIT_STOPPED, COMMIT_COUNT };

/* What runs on a board when nothing may have changed since a desk looked. */
#define EXPECT_ANY 255u            /* any mode                                */
struct expect {
	uint8_t mode;              /* enum resource_state, or EXPECT_ANY      */
	uint8_t program[32];       /* its identity                            */
};
struct expect wire_expect(struct wire_reader *in);
void wire_put_expect(struct wire_writer *out, const struct expect *expect);

/* How a request names a variable. */
enum ref_kind {
	REF_PLACE,                 /* u32: enum iec_type on top, then offset, as in code.h */
	REF_NAME,                  /* text: "Motor", "Main.Delay.ET", "%QX0.1" */
	REF_COUNT
};
struct ref {
	enum ref_kind kind;
	uint32_t place;
	const char *name;          /* borrowed from the frame                 */
	size_t len;
};
/** wire_ref - Fails: the reader has failed, also if the kind is unknown. */
struct ref wire_ref(struct wire_reader *in);
void wire_put_name(struct wire_writer *out, const char *name);

/**
 * wire_value - the value of a type as it is on the wire
 * @room: for a STRING
 *
 * A BOOL is 0 or 1; TIME and dates are 8 bytes, ns. Fails: the reader has failed; also for
 * IEC_NONE.
 */
union iec_value wire_value(struct wire_reader *in, enum iec_type type, struct iec_text *room);
void wire_put_value(struct wire_writer *out, enum iec_type type, union iec_value value);

/* Quality of a value on the board; 0: good. STALE: it may be old. FAULT, only with STALE: its device is gone,
 * answers with errors, or measures what cannot be. */
enum value_flag { VALUE_FORCED = 1, VALUE_STALE = 2, VALUE_FAULT = 4 };
#endif
