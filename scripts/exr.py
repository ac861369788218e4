"""Reads OpenEXR files with nothing beside Python's standard library."""
import struct
import zlib


def read_exr(path):
    """The channels of a scanline EXR file, as rows of numbers: uncompressed or ZIP."""
    with open(path, "rb") as file:
        data = file.read()

    def text(place):
        end = data.index(0, place)
        return data[place:end].decode(), end + 1

    attributes, place = {}, 8
    while data[place] != 0:
        name, place = text(place)
        _, place = text(place)
        (size,) = struct.unpack_from("<i", data, place)
        attributes[name] = data[place + 4:place + 4 + size]
        place += 4 + size
    place += 1

    channels, list_, at = [], attributes["channels"], 0
    while list_[at] != 0:
        end = list_.index(0, at)
        (kind,) = struct.unpack_from("<i", list_, end + 1)
        channels.append((list_[at:end].decode(), "Ief"[kind]))
        at = end + 17
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    rows_a_block = {0: 1, 2: 1, 3: 16}[attributes["compression"][0]]
    images = {name: [None] * height for name, _ in channels}
    row_size = sum(struct.calcsize(kind) for _, kind in channels) * width
    for i in range((height + rows_a_block - 1) // rows_a_block):
        (offset,) = struct.unpack_from("<Q", data, place + 8 * i)
        row, size = struct.unpack_from("<ii", data, offset)
        block = data[offset + 8:offset + 8 + size]
        count = min(rows_a_block, height - (row - top))
        if size < row_size * count:
            block = undo_prediction(bytearray(zlib.decompress(block)))
        at = 0
        for y in range(row - top, row - top + count):
            for name, kind in channels:
                images[name][y] = struct.unpack_from("<%d%s" % (width, kind), block, at)
                at += struct.calcsize(kind) * width
    return images


def undo_prediction(block):
    for i in range(1, len(block)):
        block[i] = (block[i - 1] + block[i] - 128) & 255
    half = (len(block) + 1) // 2
    result = bytearray(len(block))
    result[0::2], result[1::2] = block[:half], block[half:]
    return bytes(result)
