#!/usr/bin/env perl
# SPDX-License-Identifier: MIT
# parts - divides the programs of a bundle (tests/targets/guest/bundle.h) among files, for machines
# without the memory for all: `parts.pl BUNDLE BYTES FOLDER` writes FOLDER/part-01 and so on, each of
# BYTES at most.
use strict;
use warnings;

my $HEAD = 16;
my ($path, $most, $folder) = @ARGV;
open my $in, '<:raw', $path or die "$path: $!\n";
my $bundle = do { local $/; <$in> };
my ($magic, $first, $count) = unpack 'a8 V V', $bundle;
die "$path is no bundle\n" unless length $bundle > $HEAD && $magic eq 'RUNGPLAY';

my ($files, $begin, $programs, $bytes) = (0, $first, 0, '');
sub part {
	my $out;
	my $name = sprintf '%s/part-%02d', $folder, ++$files;

	open $out, '>:raw', $name or die "$name: $!\n";
	print $out pack('a8 V V', $magic, $begin, $programs), $bytes;
	close $out or die "$name: $!\n";
	($begin, $programs, $bytes) = ($begin + $programs, 0, '');
}

my $at = $HEAD;
for (1 .. $count) {
	my ($image, $scans, $record) = unpack 'V V V', substr $bundle, $at, 12;
	die "$path is short\n" unless defined $record && $at + 16 + $image + $record <= length $bundle;
	my $len = 16 + $image + $record;
	part() if $programs && $HEAD + length($bytes) + $len > $most;
	$bytes .= substr $bundle, $at, $len;
	$programs++;
	$at += $len;
}
die "$path is longer than its programs\n" unless $at == length $bundle;
part();
print "$count programs in $files parts\n";
