/* SPDX-License-Identifier: MIT
 *
 * bundle - the file that `replay` plays: random programs as code images, their
 * inputs, and the whole process image after every scan. All numbers little
 * endian.
 *
 *   8 bytes  RUNGPLAY
 *   u32      number of the first program, 1 unless the file is a part of another
 *   u32      how many programs
 *   then for each: u32 bytes of its image, u32 scans, u32 bytes of its record,
 *   u32 bytes of its data; the image; the record:
 *     the memory after the cold start, as changes from all zero
 *     then for each scan: u64 time in ns, BUNDLE_INPUTS bytes of %I, u8 1: the
 *     scan ended well, u32 operations that failed so far, and the changes
 *
 * Changes: a varint of their number, then for each a varint of the bytes that
 * lie between it and the one before, and the new byte.
 */
#ifndef GUEST_BUNDLE_H
#define GUEST_BUNDLE_H

#define BUNDLE_MAGIC  "RUNGPLAY"
#define BUNDLE_INPUTS 8
#define BUNDLE_IMAGE  49152 /* bytes at most of an image, a record, data     */
#define BUNDLE_RECORD 65536
#define BUNDLE_DATA   49152
#define BUNDLE_HEAD   (8 + BUNDLE_INPUTS + 1 + 4)
#endif
