-- Wireshark dissector of RAM and RMCM, the messages of Crossguard.
--
--   wireshark -X lua_script:crossguard.lua robots.pcap
--
-- or copy this file to the folder of personal Lua plugins (Help, About Wireshark, Folders). It reads
-- what follows BTP-B at the ports 2998 and 2999; other ports can be set in the preferences of the
-- protocol CROSSGUARD. Fields are named crossguard.<name of the field in the ASN.1 modules>.
--
-- Packets with a security envelope are shown down to the message as well: the plugin names the ITS-AIDs of
-- RAM, RMCM and VAM to Wireshark's dissector of IEEE 1609.2. No signature is verified, and the tree says so;
-- `crossguard sniff --trust FOLDER` verifies.
--
-- It shows what is there and is lenient: that exactly the canonical encodings are messages is decided
-- by the kit, not here. The types at the end follow from codec/asn1/*.asn by generate.py.

local types = {}

local crossguard = Proto("crossguard", "Crossguard")
crossguard.prefs.ram = Pref.uint("BTP port of RAM", 2998, "Destination port of RAM")
crossguard.prefs.rmcm = Pref.uint("BTP port of RMCM", 2999, "Destination port of RMCM")
crossguard.prefs.ram_aid = Pref.uint("ITS-AID of RAM", 16480, "Permission under which RAM are signed")
crossguard.prefs.rmcm_aid = Pref.uint("ITS-AID of RMCM", 16481, "Permission under which RMCM are signed")

-- By name: the fields, and which of them are texts.
local texts = {}
local fields = { kind = ProtoField.string("crossguard.kind", "Message") }
local broken = ProtoExpert.new("crossguard.broken", "Not a message of Crossguard",
    expert.group.MALFORMED, expert.severity.ERROR)
local unverified = ProtoExpert.new("crossguard.unverified", "The signature is not verified here",
    expert.group.SECURITY, expert.severity.NOTE)
crossguard.experts = { broken, unverified }
fields.signature = ProtoField.string("crossguard.signature", "Signature")

-- == Unaligned PER (ITU-T X.691) ==

local Reader = {}
Reader.__index = Reader

local function reader(tvb)
    return setmetatable({ tvb = tvb, at = 0, last = tvb:len() * 8 }, Reader)
end

-- The next bits as a number, at most 48.
function Reader:bits(count)
    if self.at + count > self.last then
        error("the message ends too early", 0)
    end
    local number = 0
    for _ = 1, count do
        local octet = self.tvb(math.floor(self.at / 8), 1):uint()
        local bit = math.floor(octet / 2 ^ (7 - self.at % 8)) % 2
        number = number * 2 + bit
        self.at = self.at + 1
    end
    return number
end

-- The octets that hold the bits from one on.
function Reader:range(from)
    local first = math.min(math.floor(from / 8), self.tvb:len() - 1)
    local last = math.max(first, math.floor((self.at - 1) / 8))
    return self.tvb(first, last - first + 1)
end

local function width(min, max)
    local bits, values = 0, max - min + 1
    while 2 ^ bits < values do
        bits = bits + 1
    end
    return bits
end

function Reader:length()
    local length = self:bits(8)
    if length >= 128 then
        length = (length - 128) * 256 + self:bits(8)
    end
    return length
end

-- Skips or reads an open type.
function Reader:open_type(read)
    local length = self:length()
    local after = self.at + length * 8
    if after > self.last then
        error("the message ends too early", 0)
    end
    if read then
        read()
    end
    self.at = after
end

local function beyond()
    error("something that this version does not know", 0)
end

local show

local read = {}

function read.bool(_, r)
    return r:bits(1) == 1 and "true" or "false"
end

function read.null()
    return "yes"
end

function read.int(t, r)
    if t.ext and r:bits(1) == 1 then
        beyond()
    end
    local number = r:bits(width(t.min, t.max)) + t.min
    return number, t.names and t.names[number]
end

function read.enum(t, r)
    if t.ext and r:bits(1) == 1 then
        return "addition " .. r:bits(7)
    end
    return t.root[r:bits(width(1, #t.root)) + 1] or beyond()
end

function read.bits(t, r)
    local size = t.max
    if t.min ~= t.max then
        size = r:bits(width(t.min, t.max)) + t.min
    end
    local set = {}
    for bit = 0, size - 1 do
        if r:bits(1) == 1 then
            set[#set + 1] = t.names and t.names[bit] or tostring(bit)
        end
    end
    return #set > 0 and table.concat(set, " ") or "none"
end

local nested = {}

function nested.seq(t, r, tree)
    local extended = t.ext and r:bits(1) == 1
    local present = {}
    for i, field in ipairs(t) do
        present[i] = not field.opt or r:bits(1) == 1
    end
    for i, field in ipairs(t) do
        if present[i] then
            show(field[1], field[2], r, tree)
        end
    end
    if extended then
        r:bits(1)
        local count, additions = r:bits(6) + 1, 0
        for _ = 1, count do
            additions = additions + r:bits(1)
        end
        for _ = 1, additions do
            r:open_type()
        end
        tree:append_text(" (with additions of a newer version)")
    end
end

function nested.list(t, r, tree)
    if t.ext and r:bits(1) == 1 then
        beyond()
    end
    local size = r:bits(width(t.min, t.max)) + t.min
    tree:append_text(" (" .. size .. ")")
    for _ = 1, size do
        show(t.name or "item", t.of, r, tree)
    end
end

function nested.choice(t, r, tree)
    if t.ext and r:bits(1) == 1 then
        r:bits(1)
        local alternative = t.adds[r:bits(6) + 1] or beyond()
        return r:open_type(function()
            show(alternative[1], alternative[2], r, tree)
        end)
    end
    local alternative = t.root[r:bits(width(1, #t.root)) + 1] or beyond()
    tree:append_text(": " .. alternative[1])
    show(alternative[1], alternative[2], r, tree)
end

-- Reads a field of this type and puts it into the tree.
function show(name, type, r, tree)
    if types[type] then
        type = types[type]
    end
    local from = r.at
    if nested[type.k] then
        local branch = tree:add(crossguard, r.tvb(math.floor(from / 8)), name)
        nested[type.k](type, r, branch)
        branch:set_len(math.max(1, math.floor((r.at + 7) / 8) - math.floor(from / 8)))
    else
        local value, meaning = read[type.k](type, r)
        local item = tree:add(fields[name], r:range(from), texts[name] and tostring(value) or value)
        if meaning then
            item:append_text(" (" .. meaning .. ")")
        end
    end
end

-- == The protocol ==

-- There where the packet has a security envelope.
local psid = Field.new("ieee1609dot2.psid")

function crossguard.dissector(tvb, pinfo, tree)
    local kind = pinfo.dst_port == crossguard.prefs.rmcm and "RMCM" or "RAM"
    -- The port is not always known to a postdissector of BTP; the messageId is.
    if tvb:len() > 1 then
        kind = ({ [240] = "RAM", [241] = "RMCM" })[tvb(1, 1):uint()] or kind
    end
    pinfo.cols.protocol = kind
    local root = tree:add(crossguard, tvb(), "Crossguard " .. kind)
    root:add(fields.kind, tvb(), kind):set_generated()
    if psid() then
        local item = root:add(fields.signature, tvb(0, 0), "not verified"):set_generated()
        item:add_proto_expert_info(unverified)
    end
    local r = reader(tvb)
    local good, why = pcall(function()
        for _, field in ipairs(types[kind]) do
            show(field[1], field[2], r, root)
        end
    end)
    if good and r.last - r.at >= 8 then
        good, why = false, "octets follow the end of the message"
    end
    if not good then
        root:add_proto_expert_info(broken, tostring(why))
    end
    return tvb:len()
end

-- The ITS-AID of VAM, which older versions of Wireshark do not know.
local VAM_AID = 638
-- That of CAM, which every version with GeoNetworking knows.
local CAM_AID = 36

-- Has what is signed under these ITS-AIDs read like a signed CAM: the rest of a GeoNetworking packet.
local function register_signed()
    local psids = DissectorTable.get("ieee1609dot2.psid")
    local geonetworking = psids and psids:get_dissector(CAM_AID)
    if not geonetworking then
        return
    end
    for _, aid in ipairs({ crossguard.prefs.ram_aid, crossguard.prefs.rmcm_aid, VAM_AID }) do
        if not psids:get_dissector(aid) then
            psids:add(aid, geonetworking)
        end
    end
end

-- Robots without a radio send these packets by UDP, at ports of their own: "Decode As" in Wireshark, or for those of the
-- demonstration -d udp.port==47401,crossguard.udp -d udp.port==47402,crossguard.udp.
local datagram = Proto("crossguard.udp", "GeoNetworking in UDP")
function datagram.dissector(tvb, pinfo, tree)
    return Dissector.get("gnw"):call(tvb, pinfo, tree)
end
DissectorTable.get("udp.port"):add_for_decode_as(datagram)

local ports = {}

local function register()
    local btp = DissectorTable.get("btpb.port")
    for _, port in ipairs(ports) do
        btp:remove(port, crossguard)
    end
    ports = { crossguard.prefs.ram, crossguard.prefs.rmcm }
    for _, port in ipairs(ports) do
        btp:add(port, crossguard)
    end
end

function crossguard.init()
    register()
    register_signed()
end

-- == Types, generated ==

types.AccelerationChange = { k = "enum", root = { "accelerate", "decelerate" } }
types.AccelerationChangeIndication = { k = "seq", ext = true, { "accelOrDecel", "AccelerationChange" }, { "actionDeltaTime", "DeltaTimeTenthOfSecond" } }
types.AccelerationComponent = { k = "seq", { "value", "AccelerationValue" }, { "confidence", "AccelerationConfidence" } }
types.AccelerationConfidence = { k = "int", min = 0, max = 102, names = { [101] = "outOfRange", [102] = "unavailable" } }
types.AccelerationValue = { k = "int", min = -160, max = 161, names = { [-160] = "negativeOutOfRange", [160] = "positiveOutOfRange", [161] = "unavailable" } }
types.Altitude = { k = "seq", { "altitudeValue", "AltitudeValue" }, { "altitudeConfidence", "AltitudeConfidence" } }
types.AltitudeConfidence = { k = "enum", root = { "alt-000-01", "alt-000-02", "alt-000-05", "alt-000-10", "alt-000-20", "alt-000-50", "alt-001-00", "alt-002-00", "alt-005-00", "alt-010-00", "alt-020-00", "alt-050-00", "alt-100-00", "alt-200-00", "outOfRange", "unavailable" } }
types.AltitudeValue = { k = "int", min = -100000, max = 800001, names = { [-100000] = "negativeOutOfRange", [800000] = "postiveOutOfRange", [800001] = "unavailable" } }
types.BasicContainer = { k = "seq", ext = true, { "stationType", "TrafficParticipantType" }, { "referencePosition", "ReferencePositionWithConfidence" } }
types.BatteryStatus = { k = "seq", ext = true, { "stateOfCharge", "StateOfCharge" }, { "charging", { k = "bool" } } }
types.CardinalNumber1B = { k = "int", min = 0, max = 255 }
types.CartesianAngleValue = { k = "int", min = 0, max = 3601, names = { [3600] = "valueNotUsed", [3601] = "unavailable" } }
types.CartesianCoordinate = { k = "int", min = -32768, max = 32767, names = { [-32768] = "negativeOutOfRange", [32767] = "positiveOutOfRange" } }
types.CartesianCoordinateSmall = { k = "int", min = -3094, max = 1001, names = { [-3094] = "negativeOutOfRange", [1001] = "positiveOutOfRange" } }
types.CartesianPosition3d = { k = "seq", { "xCoordinate", "CartesianCoordinate" }, { "yCoordinate", "CartesianCoordinate" }, { "zCoordinate", "CartesianCoordinate", opt = true } }
types.CircularShape = { k = "seq", { "shapeReferencePoint", "CartesianPosition3d", opt = true }, { "radius", "StandardLength12b" }, { "height", "StandardLength12b", opt = true } }
types.CommandProgress = { k = "choice", root = { { "executing", { k = "null" } }, { "inPosition", { k = "null" } }, { "completed", { k = "null" } }, { "failed", "FailureReason" }, { "safeIdle", { k = "null" } } }, ext = true, adds = {  } }
types.CommandReport = { k = "seq", { "requestID", "RequestId" }, { "progress", "CommandProgress" } }
types.ConfirmedFollower = { k = "seq", { "stationID", "StationId" }, { "offerNumber", "OfferNumber" } }
types.ControlMode = { k = "enum", root = { "autonomous", "teleoperated", "emergencyStop", "fault", "unavailable" }, ext = true }
types.CoordinationSession = { k = "seq", { "leaderStationID", "StationId" }, { "sessionNumber", "SessionNumber" } }
types.CrossingReference = { k = "seq", { "regulator", { k = "int", min = 0, max = 65535 } }, { "intersection", { k = "int", min = 0, max = 65535 } } }
types.Curvature = { k = "seq", { "curvatureValue", "CurvatureValue" }, { "curvatureConfidence", "CurvatureConfidence" } }
types.CurvatureConfidence = { k = "enum", root = { "onePerMeter-0-00002", "onePerMeter-0-0001", "onePerMeter-0-0005", "onePerMeter-0-002", "onePerMeter-0-01", "onePerMeter-0-1", "outOfRange", "unavailable" } }
types.CurvatureValue = { k = "int", min = -1023, max = 1023, names = { [-1023] = "outOfRangeNegative", [0] = "straight", [1022] = "outOfRangePositive", [1023] = "unavailable" } }
types.DeltaAltitude = { k = "int", min = -12700, max = 12800, names = { [-12700] = "negativeOutOfRange", [12799] = "positiveOutOfRange", [12800] = "unavailable" } }
types.DeltaLatitude = { k = "int", min = -131071, max = 131072, names = { [131072] = "unavailable" } }
types.DeltaLongitude = { k = "int", min = -131071, max = 131072, names = { [131072] = "unavailable" } }
types.DeltaReferencePosition = { k = "seq", { "deltaLatitude", "DeltaLatitude" }, { "deltaLongitude", "DeltaLongitude" }, { "deltaAltitude", "DeltaAltitude" } }
types.DeltaTimeSecond = { k = "int", min = 0, max = 86400 }
types.DeltaTimeTenSeconds = { k = "int", min = 0, max = 127 }
types.DeltaTimeTenthOfSecond = { k = "int", min = 0, max = 127, names = { [127] = "unavailable" } }
types.DriveDirection = { k = "enum", root = { "forward", "backward", "unavailable" } }
types.EllipticalShape = { k = "seq", { "shapeReferencePoint", "CartesianPosition3d", opt = true }, { "semiMajorAxisLength", "StandardLength12b" }, { "semiMinorAxisLength", "StandardLength12b" }, { "orientation", "CartesianAngleValue", opt = true }, { "height", "StandardLength12b", opt = true } }
types.EndedSession = { k = "seq", { "sessionNumber", "SessionNumber" }, { "ending", "SessionEnding" } }
types.ExteriorLights = { k = "bits", min = 8, max = 8, names = { [0] = "lowBeamHeadlightsOn", [1] = "highBeamHeadlightsOn", [2] = "leftTurnSignalOn", [3] = "rightTurnSignalOn", [4] = "daytimeRunningLightsOn", [5] = "reverseLightOn", [6] = "fogLightOn", [7] = "parkingLightsOn" } }
types.FailureReason = { k = "choice", root = { { "maneuver", { k = "null" } }, { "unavailable", "UnavailabilityReason" } }, ext = true, adds = {  } }
types.FollowerManeuverContainer = { k = "seq", ext = true, { "session", "CoordinationSession" }, { "jobAdviceID", "RequestId" }, { "response", "ManeuverResponse" }, { "executionStatus", "TaskProgression" }, { "estimatedTimeToCompletion", "ManeuverDuration", opt = true } }
types.FollowerRole = { k = "seq", ext = true, { "session", "CoordinationSession" }, { "heartbeatEcho", "Heartbeat" }, { "lastCommand", "CommandReport", opt = true } }
types.GenerationDeltaTime = { k = "int", min = 0, max = 65535, names = { [1] = "oneMilliSec" } }
types.GeoPosition = { k = "seq", { "latitude", "Latitude" }, { "longitude", "Longitude" }, { "altitude", "AltitudeValue", opt = true } }
types.HeadingChangeIndication = { k = "seq", ext = true, { "direction", "TurningDirection" }, { "actionDeltaTime", "DeltaTimeTenthOfSecond" } }
types.HeadingValue = { k = "int", min = 0, max = 3601, names = { [0] = "wgs84North", [900] = "wgs84East", [1800] = "wgs84South", [2700] = "wgs84West", [3600] = "doNotUse", [3601] = "unavailable" } }
types.Heartbeat = { k = "int", min = 0, max = 65535 }
types.HelpStatus = { k = "enum", root = { "none", "needHelp", "offerHelp", "roleConfirmed" }, ext = true }
types.HelperRole = { k = "seq", ext = true, { "session", "CoordinationSession" }, { "offerNumber", "OfferNumber" }, { "capabilities", "TaskSet" }, { "heartbeatEcho", "Heartbeat" }, { "safetyTimeout", "SafetyTimeout" } }
types.Identifier1B = { k = "int", min = 0, max = 255 }
types.Identifier2B = { k = "int", min = 0, max = 65535 }
types.IntersectionReferenceId = { k = "seq", { "region", "Identifier2B", opt = true }, { "id", "Identifier2B" } }
types.ItsPduHeader = { k = "seq", { "protocolVersion", "OrdinalNumber1B" }, { "messageId", "MessageId" }, { "stationId", "StationId" } }
types.LanePosition = { k = "int", min = -1, max = 14, names = { [-1] = "offTheRoad", [0] = "innerHardShoulder", [14] = "outerHardShoulder" } }
types.Latitude = { k = "int", min = -900000000, max = 900000001, names = { [900000001] = "unavailable" } }
types.LeaderManeuverContainer = { k = "seq", ext = true, { "session", "CoordinationSession" }, { "mapReference", "MapReference", opt = true }, { "commands", { k = "list", min = 1, max = 16, of = "ManeuverCommand" } } }
types.LeaderRole = { k = "seq", ext = true, { "session", "CoordinationSession" }, { "heartbeat", "Heartbeat" }, { "urgency", "RequestUrgency" }, { "crossing", "CrossingReference", opt = true }, { "yields", { k = "bool" } }, { "followers", { k = "list", min = 1, max = 16, of = "ConfirmedFollower" } } }
types.LeftSession = { k = "seq", { "session", "CoordinationSession" }, { "offerNumber", "OfferNumber" } }
types.Longitude = { k = "int", min = -1800000000, max = 1800000001, names = { [-1800000000] = "valueNotUsed", [1800000001] = "unavailable" } }
types.ManeuverCommand = { k = "seq", ext = true, { "requestID", "RequestId" }, { "targetFollowerStationID", "StationId" }, { "taskType", "TaskType" }, { "target", "ManeuverTarget", opt = true }, { "targetHeading", "Wgs84AngleValue", opt = true }, { "constraints", "ManeuverConstraints", opt = true }, { "validityDuration", "ManeuverDuration", opt = true } }
types.ManeuverConstraints = { k = "seq", ext = true, { "maximumSpeed", "SpeedValue", opt = true }, { "minimumPedestrianDistance", "StandardLength9b", opt = true } }
types.ManeuverContainer = { k = "choice", root = { { "leaderManeuverContainer", "LeaderManeuverContainer" }, { "followerManeuverContainer", "FollowerManeuverContainer" } }, ext = true, adds = {  } }
types.ManeuverDuration = { k = "int", min = 0, max = 86400000 }
types.ManeuverResponse = { k = "choice", root = { { "accepted", { k = "null" } }, { "rejected", "RejectionReason" } }, ext = true, adds = {  } }
types.ManeuverTarget = { k = "choice", root = { { "position", "GeoPosition" }, { "offset", "DeltaReferencePosition" }, { "lanePosition", "LanePosition" } }, ext = true, adds = {  } }
types.MapReference = { k = "choice", root = { { "roadsegment", "RoadSegmentReferenceId" }, { "intersection", "IntersectionReferenceId" } } }
types.MessageId = { k = "int", min = 0, max = 255, names = { [1] = "denm", [2] = "cam", [3] = "poim", [4] = "spatem", [5] = "mapem", [6] = "ivim", [7] = "rfu1", [8] = "rfu2", [9] = "srem", [10] = "ssem", [11] = "evcsn", [12] = "saem", [13] = "rtcmem", [14] = "cpm", [15] = "imzm", [16] = "vam", [17] = "dsm", [18] = "mim", [19] = "mvm", [20] = "mcm", [21] = "pim" } }
types.ObjectDimensionValue = { k = "int", min = 1, max = 256, names = { [255] = "outOfRange", [256] = "unavailable" } }
types.OfferNumber = { k = "int", min = 0, max = 4294967295 }
types.OperationalJobRole = { k = "enum", root = { "none", "trafficGuard", "escort", "patrol", "delivery", "maintenance", "other" }, ext = true }
types.OrdinalNumber1B = { k = "int", min = 0, max = 255 }
types.PathDeltaTime = { k = "int", min = 1, max = 65535, ext = true }
types.PathDeltaTimeChoice = { k = "choice", root = { { "deltaTimeHighPrecision", "DeltaTimeTenthOfSecond" }, { "deltaTimeBigRange", "DeltaTimeTenSeconds" } }, ext = true, adds = { { "deltaTimeMidRange", "DeltaTimeSecond" } } }
types.PathHistory = { k = "list", min = 0, max = 40, of = "PathPoint" }
types.PathPoint = { k = "seq", { "pathPosition", "DeltaReferencePosition" }, { "pathDeltaTime", "PathDeltaTime", opt = true } }
types.PathPointPredicted = { k = "seq", ext = true, { "deltaLatitude", "DeltaLatitude" }, { "deltaLongitude", "DeltaLongitude" }, { "horizontalPositionConfidence", "PosConfidenceEllipse", opt = true }, { "deltaAltitude", "DeltaAltitude", opt = true }, { "altitudeConfidence", "AltitudeConfidence", opt = true }, { "pathDeltaTime", "PathDeltaTimeChoice", opt = true }, { "symmetricAreaOffset", "StandardLength9b", opt = true }, { "asymmetricAreaOffset", "StandardLength9b", opt = true } }
types.PathPredicted = { k = "list", min = 1, max = 16, of = "PathPointPredicted", ext = true }
types.PolygonalShape = { k = "seq", { "shapeReferencePoint", "CartesianPosition3d", opt = true }, { "polygon", { k = "list", min = 3, max = 16, of = "CartesianPosition3d", ext = true } }, { "height", "StandardLength12b", opt = true } }
types.PosConfidenceEllipse = { k = "seq", { "semiMajorConfidence", "SemiAxisLength" }, { "semiMinorConfidence", "SemiAxisLength" }, { "semiMajorOrientation", "HeadingValue" } }
types.PositionConfidenceEllipse = { k = "seq", { "semiMajorAxisLength", "SemiAxisLength" }, { "semiMinorAxisLength", "SemiAxisLength" }, { "semiMajorAxisOrientation", "Wgs84AngleValue" } }
types.PublicSignal = { k = "enum", root = { "none", "stop", "go", "caution" }, ext = true }
types.RAM = { k = "seq", { "header", "ItsPduHeader" }, { "ram", "RobotAwareness" } }
types.RMCM = { k = "seq", { "header", "ItsPduHeader" }, { "rmcm", "RobotManeuverCoordination" } }
types.RadialShape = { k = "seq", { "shapeReferencePoint", "CartesianPosition3d", opt = true }, { "range", "StandardLength12b" }, { "horizontalOpeningAngleStart", "CartesianAngleValue" }, { "horizontalOpeningAngleEnd", "CartesianAngleValue" }, { "verticalOpeningAngleStart", "CartesianAngleValue", opt = true }, { "verticalOpeningAngleEnd", "CartesianAngleValue", opt = true } }
types.RadialShapeDetails = { k = "seq", { "range", "StandardLength12b" }, { "horizontalOpeningAngleStart", "CartesianAngleValue" }, { "horizontalOpeningAngleEnd", "CartesianAngleValue" }, { "verticalOpeningAngleStart", "CartesianAngleValue", opt = true }, { "verticalOpeningAngleEnd", "CartesianAngleValue", opt = true } }
types.RadialShapes = { k = "seq", { "refPointId", "Identifier1B" }, { "xCoordinate", "CartesianCoordinateSmall" }, { "yCoordinate", "CartesianCoordinateSmall" }, { "zCoordinate", "CartesianCoordinateSmall", opt = true }, { "radialShapesList", "RadialShapesList" } }
types.RadialShapesList = { k = "list", min = 1, max = 16, of = "RadialShapeDetails", ext = true }
types.RamParameters = { k = "seq", ext = true, { "basicContainer", "BasicContainer" }, { "robotHighFrequencyContainer", "RobotHighFrequencyContainer" }, { "robotLowFrequencyContainer", "RobotLowFrequencyContainer", opt = true }, { "robotStatusContainer", "RobotStatusContainer" }, { "robotLeaderFollowerOperationContainer", "RobotLeaderFollowerOperationContainer", opt = true }, { "vruClusterInformationContainer", "VruClusterInformationContainer", opt = true }, { "vruMotionPredictionContainer", "VruMotionPredictionContainer", opt = true } }
types.RectangularShape = { k = "seq", { "shapeReferencePoint", "CartesianPosition3d", opt = true }, { "semiLength", "StandardLength12b" }, { "semiBreadth", "StandardLength12b" }, { "orientation", "CartesianAngleValue", opt = true }, { "height", "StandardLength12b", opt = true } }
types.ReferencePositionWithConfidence = { k = "seq", { "latitude", "Latitude" }, { "longitude", "Longitude" }, { "positionConfidenceEllipse", "PositionConfidenceEllipse" }, { "altitude", "Altitude" } }
types.RejectionReason = { k = "choice", root = { { "unsupportedTask", { k = "null" } }, { "unavailable", "UnavailabilityReason" }, { "onDuty", { k = "null" } } }, ext = true, adds = {  } }
types.RequestId = { k = "int", min = 0, max = 255 }
types.RequestUrgency = { k = "enum", root = { "low", "medium", "high", "emergency" } }
types.RequesterRole = { k = "seq", ext = true, { "session", "CoordinationSession" }, { "heartbeat", "Heartbeat" }, { "urgency", "RequestUrgency" }, { "crossing", "CrossingReference", opt = true }, { "followerCount", { k = "int", min = 1, max = 16 } }, { "requestedTasks", "TaskSet" } }
types.RmcmParameters = { k = "seq", ext = true, { "basicContainer", "BasicContainer" }, { "maneuverContainer", "ManeuverContainer" } }
types.RoadSegmentReferenceId = { k = "seq", { "region", "Identifier2B", opt = true }, { "id", "Identifier2B" } }
types.RobotAwareness = { k = "seq", { "generationDeltaTime", "GenerationDeltaTime" }, { "ramParameters", "RamParameters" } }
types.RobotCapabilities = { k = "bits", min = 8, max = 8, names = { [0] = "pedestrianDetection", [1] = "leading", [2] = "following", [3] = "gestures", [4] = "display", [5] = "speech" } }
types.RobotCategory = { k = "enum", root = { "unknown", "humanoid", "quadruped", "wheeled", "tracked", "aerial", "other" }, ext = true }
types.RobotDimensions = { k = "seq", { "length", "ObjectDimensionValue" }, { "width", "ObjectDimensionValue" }, { "height", "ObjectDimensionValue" } }
types.RobotHighFrequencyContainer = { k = "seq", ext = true, { "heading", "Wgs84Angle" }, { "speed", "Speed" }, { "driveDirection", "DriveDirection" }, { "longitudinalAcceleration", "AccelerationComponent" }, { "robotDimensions", "RobotDimensions" }, { "curvature", "Curvature", opt = true }, { "yawRate", "YawRate", opt = true }, { "lateralAcceleration", "AccelerationComponent", opt = true }, { "verticalAcceleration", "AccelerationComponent", opt = true }, { "orientation", "Wgs84Angle", opt = true } }
types.RobotLeaderFollowerOperationContainer = { k = "seq", ext = true, { "role", "SessionRole", opt = true }, { "farewell", "SessionFarewell", opt = true } }
types.RobotLowFrequencyContainer = { k = "seq", ext = true, { "capabilities", "RobotCapabilities" }, { "supportedTasks", "TaskSet" }, { "pathHistory", { k = "list", min = 0, max = 23, of = "PathPoint" } }, { "exteriorLights", "ExteriorLights", opt = true }, { "signalsShown", "SignalsShown", opt = true }, { "areaServed", "MapReference", opt = true } }
types.RobotManeuverCoordination = { k = "seq", { "generationDeltaTime", "GenerationDeltaTime" }, { "rmcmParameters", "RmcmParameters" } }
types.RobotStatusContainer = { k = "seq", ext = true, { "robotCategory", "RobotCategory" }, { "operationalJobRole", "OperationalJobRole" }, { "taskProgression", "TaskProgression" }, { "batteryStatus", "BatteryStatus" }, { "controlMode", "ControlMode" }, { "helpStatus", "HelpStatus" }, { "unavailability", "UnavailabilityReason", opt = true }, { "onDuty", { k = "bool" } } }
types.SafeDistanceIndication = { k = "seq", ext = true, { "subjectStation", "StationId", opt = true }, { "safeDistanceIndicator", "SafeDistanceIndicator" }, { "timeToCollision", "DeltaTimeTenthOfSecond", opt = true } }
types.SafeDistanceIndicator = { k = "bool" }
types.SafetyTimeout = { k = "int", min = 1, max = 86400000 }
types.SemiAxisLength = { k = "int", min = 0, max = 4095, names = { [0] = "doNotUse", [4094] = "outOfRange", [4095] = "unavailable" } }
types.SequenceOfSafeDistanceIndication = { k = "list", min = 1, max = 8, of = "SafeDistanceIndication", ext = true }
types.SequenceOfTrajectoryInterceptionIndication = { k = "list", min = 1, max = 8, of = "TrajectoryInterceptionIndication", ext = true }
types.SessionEnding = { k = "enum", root = { "completed", "aborted" } }
types.SessionFarewell = { k = "choice", root = { { "ended", "EndedSession" }, { "left", "LeftSession" } }, ext = true, adds = {  } }
types.SessionNumber = { k = "int", min = 0, max = 4294967295 }
types.SessionRole = { k = "choice", root = { { "requester", "RequesterRole" }, { "helper", "HelperRole" }, { "leader", "LeaderRole" }, { "follower", "FollowerRole" } }, ext = true, adds = {  } }
types.Shape = { k = "choice", root = { { "rectangular", "RectangularShape" }, { "circular", "CircularShape" }, { "polygonal", "PolygonalShape" }, { "elliptical", "EllipticalShape" }, { "radial", "RadialShape" }, { "radialShapes", "RadialShapes" } }, ext = true, adds = {  } }
types.SignalMeans = { k = "bits", min = 8, max = 8, names = { [0] = "gesture", [1] = "display", [2] = "lights", [3] = "speech" } }
types.SignalsShown = { k = "seq", ext = true, { "toVehicles", "PublicSignal" }, { "toPedestrians", "PublicSignal" }, { "means", "SignalMeans" } }
types.Speed = { k = "seq", { "speedValue", "SpeedValue" }, { "speedConfidence", "SpeedConfidence" } }
types.SpeedConfidence = { k = "int", min = 1, max = 127, names = { [126] = "outOfRange", [127] = "unavailable" } }
types.SpeedValue = { k = "int", min = 0, max = 16383, names = { [0] = "standstill", [16382] = "outOfRange", [16383] = "unavailable" } }
types.StabilityChangeIndication = { k = "seq", ext = true, { "lossProbability", "StabilityLossProbability" }, { "actionDeltaTime", "DeltaTimeTenthOfSecond" } }
types.StabilityLossProbability = { k = "int", min = 0, max = 63, names = { [0] = "stable", [50] = "totalLossOfStability", [63] = "unavailable" } }
types.StandardLength12b = { k = "int", min = 0, max = 4095 }
types.StandardLength9b = { k = "int", min = 0, max = 511 }
types.StateOfCharge = { k = "int", min = 0, max = 101, names = { [0] = "empty", [100] = "full", [101] = "unavailable" } }
types.StationId = { k = "int", min = 0, max = 4294967295 }
types.TaskProgression = { k = "enum", root = { "idle", "executing", "inPosition", "completed", "failed", "safeIdle" }, ext = true }
types.TaskSet = { k = "bits", min = 16, max = 16, names = { [0] = "initialPos", [1] = "move", [2] = "block" } }
types.TaskType = { k = "int", min = 0, max = 15, names = { [0] = "initialPos", [1] = "move", [2] = "block" } }
types.TrafficParticipantType = { k = "int", min = 0, max = 255, names = { [0] = "unknown", [1] = "pedestrian", [2] = "cyclist", [3] = "moped", [4] = "motorcycle", [5] = "passengerCar", [6] = "bus", [7] = "lightTruck", [8] = "heavyTruck", [9] = "trailer", [10] = "specialVehicle", [11] = "tram", [12] = "lightVruVehicle", [13] = "animal", [14] = "agricultural", [15] = "infrastructure" } }
types.TrajectoryInterceptionConfidence = { k = "int", min = 0, max = 3, names = { [0] = "lessthan50percent", [1] = "between50and70Percent", [2] = "between70and90Percent", [3] = "above90Percent" } }
types.TrajectoryInterceptionIndication = { k = "seq", ext = true, { "subjectStation", "StationId", opt = true }, { "trajectoryInterceptionProbability", "TrajectoryInterceptionProbability" }, { "trajectoryInterceptionConfidence", "TrajectoryInterceptionConfidence", opt = true } }
types.TrajectoryInterceptionProbability = { k = "int", min = 0, max = 63, names = { [63] = "unavailable" } }
types.TurningDirection = { k = "enum", root = { "left", "right" } }
types.UnavailabilityReason = { k = "enum", root = { "lowBattery", "teleoperated", "emergencyStop", "localFault", "notSafe" }, ext = true }
types.VruClusterInformation = { k = "seq", ext = true, { "clusterId", "Identifier1B", opt = true }, { "clusterBoundingBoxShape", "Shape", opt = true }, { "clusterCardinalitySize", "CardinalNumber1B" }, { "clusterProfiles", "VruClusterProfiles", opt = true } }
types.VruClusterInformationContainer = { k = "seq", ext = true, { "vruClusterInformation", "VruClusterInformation" } }
types.VruClusterProfiles = { k = "bits", min = 4, max = 4, names = { [0] = "pedestrian", [1] = "bicyclist", [2] = "motorcyclist", [3] = "animal" } }
types.VruMotionPredictionContainer = { k = "seq", ext = true, { "pathHistory", "PathHistory", opt = true }, { "pathPrediction", "PathPredicted", opt = true }, { "safeDistance", "SequenceOfSafeDistanceIndication", opt = true }, { "trajectoryInterceptionIndication", "SequenceOfTrajectoryInterceptionIndication", opt = true }, { "accelerationChangeIndication", "AccelerationChangeIndication", opt = true }, { "headingChangeIndication", "HeadingChangeIndication", opt = true }, { "stabilityChangeIndication", "StabilityChangeIndication", opt = true } }
types.Wgs84Angle = { k = "seq", { "value", "Wgs84AngleValue" }, { "confidence", "Wgs84AngleConfidence" } }
types.Wgs84AngleConfidence = { k = "int", min = 1, max = 127, names = { [126] = "outOfRange", [127] = "unavailable" } }
types.Wgs84AngleValue = { k = "int", min = 0, max = 3601, names = { [0] = "wgs84North", [900] = "wgs84East", [1800] = "wgs84South", [2700] = "wgs84West", [3600] = "doNotUse", [3601] = "unavailable" } }
types.YawRate = { k = "seq", { "yawRateValue", "YawRateValue" }, { "yawRateConfidence", "YawRateConfidence" } }
types.YawRateConfidence = { k = "enum", root = { "degSec-000-01", "degSec-000-05", "degSec-000-10", "degSec-001-00", "degSec-005-00", "degSec-010-00", "degSec-100-00", "outOfRange", "unavailable" } }
types.YawRateValue = { k = "int", min = -32766, max = 32767, names = { [-32766] = "negativeOutOfRange", [32766] = "positiveOutOfRange", [32767] = "unavailable" } }

for _, name in ipairs({ "altitude", "altitudeValue", "curvatureValue", "deltaAltitude", "deltaLatitude", "deltaLongitude", "lanePosition", "latitude", "longitude", "value", "xCoordinate", "yCoordinate", "yawRateValue", "zCoordinate" }) do
    fields[name] = ProtoField.int32("crossguard." .. name, name)
end
for _, name in ipairs({ "accelOrDecel", "accepted", "altitudeConfidence", "capabilities", "charging", "clusterProfiles", "completed", "controlMode", "curvatureConfidence", "direction", "driveDirection", "ending", "executing", "executionStatus", "exteriorLights", "helpStatus", "inPosition", "maneuver", "means", "onDuty", "operationalJobRole", "requestedTasks", "robotCategory", "safeDistanceIndicator", "safeIdle", "supportedTasks", "taskProgression", "toPedestrians", "toVehicles", "unavailability", "unavailable", "unsupportedTask", "urgency", "yawRateConfidence", "yields" }) do
    fields[name] = ProtoField.string("crossguard." .. name, name)
    texts[name] = true
end
for _, name in ipairs({ "actionDeltaTime", "asymmetricAreaOffset", "clusterCardinalitySize", "clusterId", "confidence", "deltaTimeBigRange", "deltaTimeHighPrecision", "deltaTimeMidRange", "estimatedTimeToCompletion", "followerCount", "generationDeltaTime", "heartbeat", "heartbeatEcho", "height", "horizontalOpeningAngleEnd", "horizontalOpeningAngleStart", "id", "intersection", "jobAdviceID", "leaderStationID", "length", "lossProbability", "maximumSpeed", "messageId", "minimumPedestrianDistance", "offerNumber", "orientation", "pathDeltaTime", "protocolVersion", "radius", "range", "refPointId", "region", "regulator", "requestID", "safetyTimeout", "semiBreadth", "semiLength", "semiMajorAxisLength", "semiMajorAxisOrientation", "semiMajorConfidence", "semiMajorOrientation", "semiMinorAxisLength", "semiMinorConfidence", "sessionNumber", "speedConfidence", "speedValue", "stateOfCharge", "stationID", "stationId", "stationType", "subjectStation", "symmetricAreaOffset", "targetFollowerStationID", "targetHeading", "taskType", "timeToCollision", "trajectoryInterceptionConfidence", "trajectoryInterceptionProbability", "validityDuration", "verticalOpeningAngleEnd", "verticalOpeningAngleStart", "width" }) do
    fields[name] = ProtoField.uint32("crossguard." .. name, name)
end

crossguard.fields = fields
