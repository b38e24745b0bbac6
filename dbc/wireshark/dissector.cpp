#include "dbc/wireshark/script.hpp"

namespace canhil::dbc {

// A raw value has up to 64 bits, and a number of Lua only 53. Therefore the script keeps a raw value as two
// numbers of 32 bits. The pieces of a signal are the parts of bytes that contain it, the most significant
// first: {byte, number of bits below the piece, number of bits of the piece}.
const std::string_view wireshark_dissector = R"lua(
local proto = Proto(protocol.name, "Signals of " .. protocol.source)
local by_id, by_group, fields = {}, {}, {}

local function key_of(id, extended) return extended and id + 0x80000000 or id end

-- The number of a parameter group of SAE J1939: without priority, source and, for PDU1, destination.
local function group_of(id)
  local number = math.floor(id / 256) % 2^18
  return math.floor(number / 256) % 256 < 240 and number - number % 256 or number
end

for _, message in ipairs(messages) do
  by_id[key_of(message.id, message.extended)] = message
  if message.j1939 then by_group[group_of(message.id)] = message end
  for _, signal in ipairs(message.signals) do
    local name = protocol.name .. "." .. message.filter .. "." .. signal.filter
    if signal.kind == "unsigned" and signal.plain then
      signal.field = ProtoField.uint64(name, signal.name)
    elseif signal.kind == "signed" and signal.plain then
      signal.field = ProtoField.int64(name, signal.name)
    else
      signal.field = ProtoField.double(name, signal.name)
    end
    fields[#fields + 1] = signal.field
  end
end
proto.fields = fields

local function raw_of(signal, tvb)
  local high, low = 0, 0
  for _, piece in ipairs(signal.pieces) do
    local power = 2 ^ piece[3]
    low = low * power + math.floor(tvb(piece[1], 1):uint() / 2 ^ piece[2]) % power
    high = (high * power + math.floor(low / 2^32)) % 2^32
    low = low % 2^32
  end
  return high, low
end

local function is_negative(signal, high, low)
  if signal.kind ~= "signed" then return false end
  if signal.length > 32 then return high >= 2 ^ (signal.length - 33) end
  return low >= 2 ^ (signal.length - 1)
end

-- The raw value as a number of Lua, and of an integer exactly as a 64-bit integer of Wireshark. The
-- parentheses drop the second result of unpack().
local function numbers_of(signal, high, low)
  if signal.kind == "float" then return (Struct.unpack(">f", Struct.pack(">I4", low))) end
  if signal.kind == "double" then return (Struct.unpack(">d", Struct.pack(">I4I4", high, low))) end
  local number = high * 2^32 + low
  if not is_negative(signal, high, low) then
    return number, signal.kind == "signed" and Int64.new(low, high) or UInt64.new(low, high)
  end
  local whole_high = signal.length > 32 and high + 2^32 - 2 ^ (signal.length - 32) or 2^32 - 1
  local whole_low = signal.length > 32 and low or low + 2^32 - 2 ^ signal.length
  return -((2^32 - 1 - whole_high) * 2^32 + (2^32 - whole_low)), Int64.new(whole_low, whole_high)
end

local function is_present(message, signal, tvb)
  if not signal.multiplexor then return true end
  local above = message.signals[signal.multiplexor]
  if above.bytes > tvb:len() or not is_present(message, above, tvb) then return false end
  local high, low = raw_of(above, tvb)
  local number = high * 2^32 + low
  for _, range in ipairs(signal.ranges) do
    if number >= range[1] and number <= range[2] then return true end
  end
  return false
end

local function add_signal(tree, signal, tvb)
  if signal.bytes > tvb:len() then
    tree:add(tvb(), signal.name .. ": missing, the frame is too short")
    return
  end
  local high, low = raw_of(signal, tvb)
  local number, integer = numbers_of(signal, high, low)
  local range = tvb(signal.first, signal.bytes - signal.first)
  local item
  if integer and signal.plain then
    item = tree:add(signal.field, range, integer)
  else
    item = tree:add(signal.field, range, number * signal.scale + signal.offset)
  end
  local name = integer and signal.values[tostring(integer)]
  if signal.unit ~= "" then item:append_text(" " .. signal.unit) end
  if name then item:append_text(" (" .. name .. ")") end
end

local id_field, extended_field = Field.new("can.id"), Field.new("can.flags.xtd")

local function message_of_frame()
  local id, extended = id_field(), extended_field()
  if not id then return nil end
  local is_extended = extended ~= nil and extended.value and extended.value ~= 0
  return by_id[key_of(id.value, is_extended)] or (is_extended and by_group[group_of(id.value)]) or nil
end

function proto.dissector(tvb, pinfo, tree)
  local message = message_of_frame()
  if not message then return 0 end
  pinfo.cols.protocol = protocol.name
  pinfo.cols.info:append(" " .. message.name)
  local branch = tree:add(proto, tvb(), message.name)
  for _, signal in ipairs(message.signals) do
    if is_present(message, signal, tvb) then add_signal(branch, signal, tvb) end
  end
  return tvb:len()
end

for _, message in ipairs(messages) do
  DissectorTable.get(message.extended and "can.extended_id" or "can.id"):add(message.id, proto)
end
if next(by_group) then
  proto:register_heuristic("can", function(tvb, pinfo, tree)
    return message_of_frame() ~= nil and proto.dissector(tvb, pinfo, tree) > 0
  end)
end
)lua";

}  // namespace canhil::dbc
